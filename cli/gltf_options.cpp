#include "gltf_options.h"

#include <string>
#include <utility>
#include <vector>

#include "common_options.h"

namespace quadrille::cli {
namespace {

/// An option whose value is one of a few names.
template <class T>
void declare_choice(CLI::App& parser, const std::string& name, T& target,
                    const std::vector<std::pair<std::string, T>>& choices,
                    const std::string& description) {
  std::vector<std::string> names;
  for (const auto& [choice, value] : choices) names.push_back(choice);
  parser
      .add_option_function<std::string>(
          name,
          [&target, choices](const std::string& given) {
            for (const auto& [choice, value] : choices) {
              if (choice == given) target = value;
            }
          },
          description)
      ->check(CLI::IsMember(names))
      ->default_str(names.front());
}

}  // namespace

void declare_gltf_options(CLI::App& parser, GltfOptions& options) {
  declare_choice<GltfColors>(
      parser, "--gltf-colors", options.colors,
      {{"texture", GltfColors::texture}, {"vertex", GltfColors::vertex}},
      "where .glb and .gltf files hold the colours: texture, or vertex: no pictures, but finer "
      "triangles");
  parser
      .add_option("--texture-ppi", options.texels_per_pixel,
                  "texels per pixel of the picture, for .glb and .gltf; fewer where a side would "
                  "exceed 8192")
      ->check(positive_number())
      ->check(number_from(1 / 64.0, 1024))
      ->capture_default_str();
  declare_choice<GltfTextureFormat>(parser, "--texture-format", options.texture_format,
                                    {{"png", GltfTextureFormat::png},
                                     {"webp", GltfTextureFormat::webp},
                                     {"jpeg", GltfTextureFormat::jpeg}},
                                    "textures of .glb and .gltf: png, webp, which some readers do "
                                    "not know, or jpeg, which leaves those with transparency png");
  parser.add_option("--texture-quality", options.texture_quality, "of webp and jpeg textures")
      ->check(whole_number_from(1, 100))
      ->capture_default_str();
  parser.add_flag("--gltf-lit", options.lit,
                  "a rough white-paper material that lights shade, instead of an unlit one");
  parser
      .add_option("--gltf-relief", options.relief,
                  "lifts .glb and .gltf surfaces by their brightness: height of white in pixels")
      ->check(number_from(-1e6, 1e6))
      ->type_name("S")
      ->capture_default_str();
  declare_choice<GltfCompression>(
      parser, "--gltf-compress", options.compression,
      {{"none", GltfCompression::none},
       {"quantize", GltfCompression::quantize},
       {"meshopt", GltfCompression::meshopt}},
      "vertices of .glb and .gltf: none, quantize (16 bits), or meshopt, which is smallest but "
      "which some readers do not know");
}

}  // namespace quadrille::cli
