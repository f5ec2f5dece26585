#pragma once

#include <filesystem>
#include <string>

#include "common/problem.h"

namespace metamer::cli {

/// Writes beside `file`, then renames: nobody ever sees half of it, and a failure leaves an older
/// file as it was.
Result<void> write_text_file(const std::filesystem::path& file, const std::string& text);

/// Runs gnuplot on a script that writes a PNG on stdout, and keeps that as `file`, as carefully as
/// write_text_file. Reads nobody's start-up files. Errors: there is no gnuplot, or it ends without
/// a picture (with its own words).
Result<void> draw_png(const std::string& script, const std::filesystem::path& file);

/// `words` as a script's literal: in single quotes gnuplot takes every character as it is, but for
/// the quote. Control characters, which could end the line, become `?`.
std::string gnuplot_quote(const std::string& words);

}  // namespace metamer::cli
