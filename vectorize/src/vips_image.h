#pragma once

#include <vips/vips.h>

#include <memory>
#include <string>

namespace quadrille {

struct VipsUnref {
  void operator()(void* object) const { g_object_unref(object); }
};
using VipsImagePtr = std::unique_ptr<VipsImage, VipsUnref>;
using VipsSourcePtr = std::unique_ptr<VipsSource, VipsUnref>;

/// Starts libvips once and keeps it from printing. Throws Error{io_failure} when it does not start.
void start_vips();

/// The last line that libvips reported, which is the fatal one, empty when it gave no reason.
/// Forgets everything reported so far.
std::string take_vips_error();

/// Takes the result of a libvips operation that writes to `out` and returns 0 for success; null
/// when it failed.
template <class Operation>
VipsImagePtr vips_result(const Operation& operation) {
  VipsImage* out = nullptr;
  const bool failed = operation(&out) != 0;
  VipsImagePtr image(out);
  if (failed) image.reset();
  return image;
}

}  // namespace quadrille
