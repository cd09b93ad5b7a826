#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exporters/drawing_program.h"

namespace quadrille::bench {

/// A file that stands for a picture: one of our formats and levels, or what a tracer makes of it.
struct Output {
  enum class Maker { ours, vtracer, potrace };

  std::string name;
  std::string ending;
  Maker maker = Maker::ours;
  std::vector<std::string> arguments;  ///< of `quadrille export`; for VTracer its preset
  std::vector<std::string> programs;   ///< that draw it

  bool is_ours() const { return maker == Maker::ours; }
};

/// What the bench makes of every picture, ours first.
const std::vector<Output>& all_outputs();

/// What outputs are made from.
struct OutputSource {
  std::filesystem::path picture;   ///< for VTracer
  std::filesystem::path pixmap;    ///< the picture over white as PPM, for potrace
  std::filesystem::path document;  ///< for the exporters
};

/// True when this build's command knows the arguments, and the tracer is there.
bool is_available(const Output& output);

/// Writes the file; throws Error{io_failure} with what the program said when it fails.
void make(const Output& output, const OutputSource& source, const std::filesystem::path& file);

/// Runs `quadrille` with these arguments; throws Error{io_failure} with what it said on failure.
void run_command(const std::vector<std::string>& arguments);

}  // namespace quadrille::bench
