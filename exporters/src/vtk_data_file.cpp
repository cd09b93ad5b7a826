#include "vtk_data_file.h"

#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <exception>
#include <fstream>

#include "quadrille/error.h"
#include "vtk_silence.h"

namespace quadrille {
namespace {

vtkSmartPointer<vtkXMLWriter> writer_of(vtkDataObject* data) {
  if (data->IsA("vtkPolyData")) return vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  if (data->IsA("vtkImageData")) return vtkSmartPointer<vtkXMLImageDataWriter>::New();
  return vtkSmartPointer<vtkXMLUnstructuredGridWriter>::New();
}

/// Passes VTK's progress on and keeps what the observer throws, since VTK is not made for
/// exceptions.
struct Watch {
  const RunContext& context;
  const std::string& stage;
  std::exception_ptr failure;

  static void report(vtkObject* caller, unsigned long, void* client, void*) {
    auto& watch = *static_cast<Watch*>(client);
    auto* const writer = static_cast<vtkAlgorithm*>(caller);
    if (watch.failure) return;
    try {
      watch.context.progress(watch.stage, writer->GetProgress());
    } catch (...) {
      watch.failure = std::current_exception();
      writer->AbortExecuteOn();
    }
  }
};

/// The writer's own errors of a full disk would name the temporary, so it writes to memory.
std::string bytes_of(vtkDataObject* data, const std::string& stage, const RunContext& context) {
  const auto writer = writer_of(data);
  vtkNew<SilentObserver> silent;
  writer->AddObserver(vtkCommand::ErrorEvent, silent);
  Watch watch{context, stage, nullptr};
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(Watch::report);
  progress->SetClientData(&watch);
  writer->AddObserver(vtkCommand::ProgressEvent, progress);
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == 0;
  if (watch.failure) std::rethrow_exception(watch.failure);
  if (!written) {
    throw Error(ErrorCode::numerical_failure, "VTK cannot write these data; report the picture");
  }
  return writer->GetOutputString();
}

}  // namespace

std::string data_file_ending(vtkDataObject* data) {
  return std::string(".") + writer_of(data)->GetDefaultFileExtension();
}

void write_data_file(vtkDataObject* data, const std::filesystem::path& path,
                     const std::filesystem::path& named, const std::string& stage,
                     const RunContext& context) {
  const std::string bytes = bytes_of(data, stage, context);
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file) {
    throw Error(ErrorCode::io_failure, "cannot write '" + named.string() +
                                           "': not all bytes arrived; check the free space of the "
                                           "disk");
  }
}

}  // namespace quadrille
