#pragma once

#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <string>
#include <utility>
#include <vector>

#include "quadrille/scene_layer.h"

namespace quadrille {

/// The array under its name, with its meaning as VTK's label of units; vectors get y up and a third
/// component.
vtkSmartPointer<vtkDataArray> to_vtk(const SceneArray& array);

/// An array of VTK's of the type Array, named, with its meaning as label of units.
template <class Array>
vtkSmartPointer<Array> named_array(const char* name, int components, const char* meaning) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), meaning);
  return array;
}

/// Texts for a field array.
vtkSmartPointer<vtkStringArray> string_array(const char* name,
                                             const std::vector<std::string>& texts);

}  // namespace quadrille
