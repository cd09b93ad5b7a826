#include "quadrille/cross_field.h"

#include <algorithm>
#include <cmath>

#include "cancel_singularities.h"
#include "option_checks.h"
#include "paper_field.h"
#include "quadrille/error.h"

namespace quadrille {
namespace {

using Complex = std::complex<float>;

// Full multigrid and one more cycle, then a cycle a round: solving to the last digit changes
// neither the number of singularities nor the misalignment.
constexpr int kFirstCycles = 1, kRoundCycles = 1;

/// The steps of cross_field(), with what they share.
class Phases {
 public:
  Phases(const FeatureTensor& features, const CrossFieldOptions& options, const RunContext& context)
      : features_(features),
        options_(options),
        context_(context),
        data_(data_term(features, options.alignment)),
        angles_(angle_field(features, options.alignment, context)),
        solver_(data_.mass, context) {}

  void solve() {
    field_.z = solver_.estimate(data_.pull);
    solver_.improve(data_.pull, field_.z, kFirstCycles);
    finish("smooth");
  }

  void renormalise() {
    pull_toward_unit_length();
    for (int round = 0; round < options_.renormalizing_rounds; ++round) {
      context_.progress("cross field", (round + 1.0) / (options_.renormalizing_rounds + 3));
      smooth_from_unit_length();
    }
    for (Complex& z : field_.z.data) z = unit(z);
    finish("renormalised");
  }

  void cancel() {
    const FieldGrid<unsigned char> changed = cancel_singularities(
        angles_, {options_.cancelling_radius, options_.cancelling_allowance}, context_);
    for (std::size_t i = 0; i < changed.data.size(); ++i) {
      if (changed.data[i]) field_.z.data[i] = from_turns(angles_.turns.data[i]);
    }
    finish("cancelled");
  }

  void follow_paper() {
    field_.z = paper_field(features_, context_);
    finish("paper");
  }

  CrossField take() { return std::move(field_); }

 private:
  const FeatureTensor& features_;
  const CrossFieldOptions& options_;
  const RunContext& context_;
  DataTerm data_;
  AngleField angles_;
  GridSolver<Complex> solver_;
  CrossField field_;

  void pull_toward_unit_length() {
    FieldGrid<float> mass = data_.mass;
    for (float& m : mass.data) m += static_cast<float>(options_.renormalizing_weight);
    solver_.set_mass(mass);
  }

  void smooth_from_unit_length() {
    const float mu = static_cast<float>(options_.renormalizing_weight);
    ComplexGrid b = data_.pull;
    for (std::size_t i = 0; i < b.data.size(); ++i) b.data[i] += mu * unit(field_.z.data[i]);
    solver_.improve(b, field_.z, kRoundCycles);
  }

  void finish(const char* name) {
    set_turns(field_.z, angles_, context_);
    field_.phases.push_back({name, singularities(field_), energy(angles_, context_),
                             misalignment_degrees(field_, features_)});
  }
};

}  // namespace

void check_options(const CrossFieldOptions& options) {
  const auto weight = [](double w) { return w > 0 && w <= kMaxAlignment; };
  if (!weight(options.alignment) || !weight(options.renormalizing_weight)) {
    throw Error(ErrorCode::invalid_argument,
                "the cross field's weights must be positive and at most " +
                    std::to_string(static_cast<int>(kMaxAlignment)) +
                    "; use an alignment such as 0.2");
  }
  if (options.renormalizing_rounds < 0 || options.cancelling_radius < 0 ||
      options.cancelling_radius > kMaxCancellingRadius || !(options.cancelling_allowance >= 0)) {
    throw Error(ErrorCode::invalid_argument,
                "the cross field's renormalising rounds, cancelling radius (at most " +
                    std::to_string(kMaxCancellingRadius) +
                    ") and cancelling allowance must not be negative");
  }
}

CrossField cross_field(const FeatureTensor& features, const CrossFieldOptions& options,
                       const RunContext& context) {
  check_options(options);
  Phases phases(features, options, context);
  if (options.method == CrossFieldMethod::paper) {
    phases.follow_paper();
  } else {
    phases.solve();
    phases.renormalise();
    if (options.cancelling_radius > 0) phases.cancel();
  }
  return phases.take();
}

}  // namespace quadrille
