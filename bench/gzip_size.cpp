#include "gzip_size.h"

#include <zlib.h>

#include <fstream>
#include <iterator>
#include <string>

namespace quadrille::bench {

std::size_t gzip_size(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_COMPRESSION);
  constexpr std::size_t kLongerGzipFrame = 12;  // than zlib's
  return size + kLongerGzipFrame;
}

}  // namespace quadrille::bench
