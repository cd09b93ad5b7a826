// Reads damaged documents by the million: no crash, no error but our own, no memory beyond what
// document.h promises.
#include <fmt/core.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <ctime>
#include <new>

#include "quadrille/document.h"
#include "quadrille/error.h"
#include "quadrille/image_file.h"
#include "quadrille/vectorize.h"
#include "support/document_fuzz.h"

namespace {

std::size_t in_use = 0, most_in_use = 0;

void* allocate(std::size_t size, std::size_t alignment) {
  void* p = alignment > alignof(std::max_align_t)
                ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                : std::malloc(size);
  if (!p) throw std::bad_alloc();
  in_use += malloc_usable_size(p);
  most_in_use = std::max(most_in_use, in_use);
  return p;
}

void release(void* p) noexcept {
  if (p) in_use -= malloc_usable_size(p);
  std::free(p);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace {

using quadrille::DocumentEncoding;
using quadrille::DocumentOptions;
using quadrille::VectorImage;

/// Every third edge becomes a tear with the same colours on both sides.
VectorImage with_tears(VectorImage image) {
  quadrille::PatchMesh& patches = image.layers[0].patches;
  const quadrille::PatchMesh before = patches;
  quadrille::QuadMesh mesh = patches.mesh;
  for (int e = 0; e < mesh.edge_count(); e += 3) mesh.edge_flags[e] |= quadrille::kTearEdge;
  patches = quadrille::straight_patches(std::move(mesh));
  patches.edge_tangents = before.edge_tangents;
  patches.opaque = before.opaque;
  for (std::size_t h = 0; h < patches.wedge_of_corner.size(); ++h) {
    patches.wedges[patches.wedge_of_corner[h]] = before.wedges[before.wedge_of_corner[h]];
  }
  return image;
}

std::vector<std::vector<std::byte>> good_documents() {
  std::vector<std::vector<std::byte>> good;
  for (const char* name : {"flower_256_alpha.png", "flower_tulips.png"}) {
    const auto picture =
        quadrille::load_image(std::string(QUADRILLE_SOURCE_DIR) + "/samples/pictures/" + name);
    quadrille::VectorizeOptions options;
    options.quads = 40;
    const VectorImage image = quadrille::vectorize(picture, options, {.threads = 1}).image;
    for (const VectorImage& version : {image, with_tears(image)}) {
      good.push_back(quadrille::to_document(version));
      good.push_back(quadrille::to_document(version, {DocumentEncoding::lossless}));
    }
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App parser("Reads damaged .quad documents", "./dev bench fuzz-quad");
  long long count = 1'000'000;
  std::uint32_t seed = 1;
  parser.add_option("--count", count, "how many")->capture_default_str();
  parser.add_option("--seed", seed, "of the damage")->capture_default_str();
  CLI11_PARSE(parser, argc, argv);

  quadrille::testing::DocumentFuzz fuzz(good_documents(), seed);
  long long accepted = 0, too_large = 0;
  double largest_share = 0;
  const std::clock_t start = std::clock();
  for (long long i = 0; i < count; ++i) {
    const std::vector<std::byte> bytes = fuzz.next();
    const std::size_t before = in_use;
    most_in_use = in_use;
    try {
      quadrille::from_document(bytes);
      ++accepted;
    } catch (const quadrille::Error&) {
    }
    const auto allowed = static_cast<double>(16384 * bytes.size() + (4 << 20));
    const double share = static_cast<double>(most_in_use - before) / allowed;
    largest_share = std::max(largest_share, share);
    too_large += share > 1;
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  fmt::print("{} documents: {} read, {} refused, {} with too much memory\n", count, accepted,
             count - accepted, too_large);
  fmt::print("memory at most {:.1f} % of the bound; {:.0f} CPU seconds\n", 100 * largest_share,
             seconds);
  return too_large == 0 ? 0 : 1;
}
