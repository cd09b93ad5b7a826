#pragma once

#include <string>

namespace quadrille {

/// Why a file of this ending (with the dot, in lower case) cannot be read or written here: a phrase
/// that tells formats which this build leaves out from endings that nobody knows.
std::string why_unknown(const std::string& ending);

}  // namespace quadrille
