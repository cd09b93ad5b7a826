#include "quadrille/run_context.h"

#include "quadrille/error.h"

namespace quadrille {

void RunContext::progress(const std::string& stage, double fraction) const {
  if (on_progress && !on_progress(stage, fraction)) {
    throw Error(ErrorCode::cancelled, "cancelled during " + stage + "; nothing was written");
  }
}

}  // namespace quadrille
