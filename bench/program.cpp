#include "program.h"

#include <fstream>

namespace quadrille::bench {

bool write_json(const nlohmann::ordered_json& json, const std::string& file) {
  if (file.empty()) return true;
  std::ofstream stream(file);
  stream << json.dump(1) << '\n';
  return static_cast<bool>(stream.flush());
}

}  // namespace quadrille::bench
