# SPDX-License-Identifier: Apache-2.0
"""Settings of Sphinx for the pages that scripts/build-site has staged."""

project = "Trisect"
author = "The Trisect authors"
extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc"]
source_suffix = {".md": "markdown"}
root_doc = "index"
html_theme = "furo"
html_title = "Trisect"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["_extra"]
html_copy_source = False
html_show_sphinx = False
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]
suppress_warnings = ["myst.header"]  # a table may stand before the first heading of its level
nitpicky = False
pygments_style = "friendly"
pygments_dark_style = "github-dark"
numpydoc_show_class_members = False
autodoc_member_order = "bysource"
html_theme_options = {
    # Blue and orange: colours that the colour-blind can tell apart, as in the pictures.
    "light_css_variables": {"color-brand-primary": "#0b5394", "color-brand-content": "#0b5394"},
    "dark_css_variables": {"color-brand-primary": "#f0a04b", "color-brand-content": "#f0a04b"},
}
