#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "document_container.h"

namespace quadrille {

/// Throws Error{io_failure}, naming the document, unless all numbers of all elements are finite.
template <class Number, class Element>
void check_finite(const std::vector<Element>& elements, const std::string& name) {
  static_assert(sizeof(Element) % sizeof(Number) == 0);
  const auto* numbers = reinterpret_cast<const Number*>(elements.data());
  const std::size_t count = elements.size() * (sizeof(Element) / sizeof(Number));
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(numbers[i])) report_damaged_document(name, "a number is not finite");
  }
}

}  // namespace quadrille
