// SPDX-License-Identifier: Apache-2.0
//
// libpng leaves by longjmp, which runs no destructors: all that it may leave is in functions that
// have none, and keeps what it took in PngReader.
#include <trisect/bsp/csg/drawing/picture.h>

#include <png.h>

#include <csetjmp>
#include <cstring>

#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

constexpr std::size_t most_message = 100;

struct PngReader {
    std::string_view rest;
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::vector<png_byte> pixels;  ///< three bytes each
    std::vector<png_bytep> rows;
    char message[most_message] = "";

    PngReader() = default;
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(reader->message, text, most_message - 1);
    png_longjmp(png, 1);
}

void on_warning(png_structp /*png*/, png_const_charp /*text*/) {}

void on_read(png_structp png, png_bytep to, std::size_t size) {
    auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > reader->rest.size()) png_error(png, "the file ends early");
    std::memcpy(to, reader->rest.data(), size);
    reader->rest.remove_prefix(size);
}

/// The size, and a transformation to eight bits each of red, green and blue. False at an error.
bool read_header(PngReader& reader) {
    if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
    png_set_read_fn(reader.png, &reader, on_read);
    png_set_chunk_malloc_max(reader.png, 1U << 20);
    png_read_info(reader.png, reader.info);
    png_set_expand(reader.png);
    png_set_strip_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_strip_alpha(reader.png);
    (void)png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

bool read_pixels(PngReader& reader) {
    if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
    png_read_image(reader.png, reader.rows.data());
    png_read_end(reader.png, nullptr);
    return true;
}

double brightness(const png_byte* pixel) {
    return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
}

}  // namespace

std::vector<std::vector<double>> png_brightness(std::string_view bytes, const std::string& name,
                                                std::size_t most) {
    const auto fail = [&](const std::string& why) {
        throw InputError(FilePlace{name, 0, 0, 0}, "the picture is malformed: " + why);
    };
    constexpr std::size_t signature = 8;
    if (bytes.size() < signature ||
        png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, signature) != 0)
        fail("it is no PNG file");
    PngReader reader;
    reader.rest = bytes;
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
    if (reader.png != nullptr) reader.info = png_create_info_struct(reader.png);
    if (reader.info == nullptr) throw LimitError(name + ": no memory for a picture");
    if (!read_header(reader)) fail(reader.message);
    const std::size_t width = png_get_image_width(reader.png, reader.info);
    const std::size_t height = png_get_image_height(reader.png, reader.info);
    if (width > most / height) throw LimitError(name + ": the picture has too many points");
    if (png_get_rowbytes(reader.png, reader.info) != 3 * width) fail("its kind is not known");
    reader.pixels.resize(3 * width * height);
    for (std::size_t y = 0; y < height; ++y)
        reader.rows.push_back(reader.pixels.data() + 3 * width * y);
    if (!read_pixels(reader)) fail(reader.message);
    std::vector<std::vector<double>> out(height);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            out[y].push_back(brightness(reader.rows[y] + 3 * x));
    return out;
}

}  // namespace trisect::detail
