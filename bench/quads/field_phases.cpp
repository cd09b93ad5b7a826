#include "field_phases.h"

namespace quadrille::bench {
namespace {

FieldPhase phase_of(const std::string& name, const CrossField& field,
                    const FeatureTensor& features) {
  return {name, static_cast<int>(singularities(field).size()),
          misalignment_degrees(field, features)};
}

}  // namespace

std::vector<FieldPhase> field_phases(const Quadrangulation& quads) {
  if (quads.cross.z.data.empty()) return {};  // the lattice
  return {phase_of("renormalised", quads.cross, quads.features)};
}

}  // namespace quadrille::bench
