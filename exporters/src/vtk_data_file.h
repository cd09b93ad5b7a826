#pragma once

#include <filesystem>
#include <string>

#include "quadrille/run_context.h"

class vtkDataObject;

namespace quadrille {

/// Writes an unstructured grid, poly data or image data in VTK's XML format, the data appended and
/// compressed by zlib. Progress is reported as `stage`; throws Error{cancelled}, and
/// Error{io_failure} when the bytes do not all arrive, naming `named`. Not atomic.
void write_data_file(vtkDataObject* data, const std::filesystem::path& path,
                     const std::filesystem::path& named, const std::string& stage,
                     const RunContext& context);

/// The ending of the files that write_data_file() makes of this data.
std::string data_file_ending(vtkDataObject* data);

}  // namespace quadrille
