#include "vtk_arrays.h"

#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace quadrille {
namespace {

template <class T>
struct ArrayOf;
template <>
struct ArrayOf<float> {
  using Type = vtkFloatArray;
};
template <>
struct ArrayOf<std::int32_t> {
  using Type = vtkIntArray;
};
template <>
struct ArrayOf<std::uint8_t> {
  using Type = vtkUnsignedCharArray;
};

template <class T>
vtkSmartPointer<vtkDataArray> copied(const SceneArray& array, const std::vector<T>& values) {
  using Array = typename ArrayOf<T>::Type;
  const auto tuples = static_cast<vtkIdType>(values.size() / array.components);
  const bool is_vector = array.kind == SceneArray::Kind::vector;
  auto copy = named_array<Array>(array.name.c_str(), is_vector ? 3 : array.components,
                                 array.meaning.c_str());
  copy->SetNumberOfTuples(tuples);
  if (!is_vector) {
    std::ranges::copy(values, copy->GetPointer(0));
    return copy;
  }
  for (vtkIdType i = 0; i < tuples; ++i) {
    copy->SetTypedComponent(i, 0, values[2 * i]);
    copy->SetTypedComponent(i, 1, static_cast<T>(-values[2 * i + 1]));
    copy->SetTypedComponent(i, 2, T(0));
  }
  return copy;
}

}  // namespace

vtkSmartPointer<vtkDataArray> to_vtk(const SceneArray& array) {
  return std::visit([&](const auto& values) { return copied(array, values); }, array.values);
}

vtkSmartPointer<vtkStringArray> string_array(const char* name,
                                             const std::vector<std::string>& texts) {
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (const std::string& text : texts) array->InsertNextValue(text);
  return array;
}

}  // namespace quadrille
