// SPDX-License-Identifier: Apache-2.0
//
// Sub-commands of trisect.
// Each has a file of its own with two functions: `add_...` declares its options on a command
// line, `run_...` does the work.
#pragma once

#include <CLI/CLI.hpp>

#include "options.h"
#include "outcome.h"
#include "session.h"

namespace trisect::app {

/// union, intersection, difference, xor, and resolve, the union of one input.
void add_boolean_commands(CLI::App& app, BooleanOptions& options);
[[nodiscard]] Outcome run_boolean(Session& session, const BooleanOptions& options);

void add_split_command(CLI::App& app, SplitOptions& options);
[[nodiscard]] Outcome run_split(Session& session, const SplitOptions& options);

void add_info_command(CLI::App& app, InfoOptions& options);
[[nodiscard]] Outcome run_info(Session& session, const InfoOptions& options);

void add_check_command(CLI::App& app, CheckOptions& options);
[[nodiscard]] Outcome run_check(Session& session, const CheckOptions& options);

void add_mend_command(CLI::App& app, MendCommandOptions& options);
[[nodiscard]] Outcome run_mend(Session& session, const MendCommandOptions& options);

void add_diff_command(CLI::App& app, DiffOptions& options);
[[nodiscard]] Outcome run_diff(Session& session, const DiffOptions& options);

void add_verify_command(CLI::App& app, VerifyCommandOptions& options);
[[nodiscard]] Outcome run_verify(Session& session, const VerifyCommandOptions& options);

void add_corpus_command(CLI::App& app, CorpusOptions& options);
[[nodiscard]] Outcome run_corpus(Session& session, const CorpusOptions& options);

void add_convert_command(CLI::App& app, ConvertOptions& options);
[[nodiscard]] Outcome run_convert(Session& session, const ConvertOptions& options);

void add_tessellate_command(CLI::App& app, TessellateOptions& options);
[[nodiscard]] Outcome run_tessellate(Session& session, const TessellateOptions& options);

void add_eval_command(CLI::App& app, EvalOptions& options);
[[nodiscard]] Outcome run_eval(Session& session, const EvalOptions& options);

void add_locate_command(CLI::App& app, LocateOptions& options);
[[nodiscard]] Outcome run_locate(Session& session, const LocateOptions& options);

void add_sweep_command(CLI::App& app, SweepOptions& options);
[[nodiscard]] Outcome run_sweep(Session& session, const SweepOptions& options);

void add_section_command(CLI::App& app, SectionOptions& options);
[[nodiscard]] Outcome run_section(Session& session, const SectionOptions& options);

void add_render_command(CLI::App& app, RenderOptions& options);
[[nodiscard]] Outcome run_render(Session& session, const RenderOptions& options);

void add_view_command(CLI::App& app, ViewOptions& options);
[[nodiscard]] Outcome run_view(Session& session, const ViewOptions& options);

void add_tree_command(CLI::App& app, TreeOptions& options);
[[nodiscard]] Outcome run_tree(Session& session, const TreeOptions& options);

void add_interfere_command(CLI::App& app, InterfereOptions& options);
[[nodiscard]] Outcome run_interfere(Session& session, const InterfereOptions& options);

void add_clash_command(CLI::App& app, ClashOptions& options);
[[nodiscard]] Outcome run_clash(Session& session, const ClashOptions& options);

void add_mill_command(CLI::App& app, MillOptions& options);
[[nodiscard]] Outcome run_mill(Session& session, const MillOptions& options);

/// --assume-embedded and --winding.
void add_operand_options(CLI::App& command, OperandOptions& options);

}  // namespace trisect::app
