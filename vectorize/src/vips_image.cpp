#include "vips_image.h"

#include <mutex>

#include "quadrille/error.h"

namespace quadrille {

void start_vips() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (VIPS_INIT("quadrille") != 0) {
      throw Error(ErrorCode::io_failure,
                  "libvips does not start (" + take_vips_error() + "); check its installation");
    }
    // No operation is repeated; the cache would only keep pictures in memory.
    vips_cache_set_max(0);
    // GObject warns about the sizes that some damaged files claim, before libvips refuses them.
    for (const char* domain : {"VIPS", "GLib-GObject"}) {
      g_log_set_handler(
          domain, G_LOG_LEVEL_WARNING, [](const gchar*, GLogLevelFlags, const gchar*, gpointer) {},
          nullptr);
    }
  });
}

std::string take_vips_error() {
  char* const text = vips_error_buffer_copy();
  std::string message(text);
  g_free(text);
  message.erase(message.find_last_not_of('\n') + 1);
  return message.substr(message.rfind('\n') + 1);
}

}  // namespace quadrille
