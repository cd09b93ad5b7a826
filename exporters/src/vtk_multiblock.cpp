#include <vtkNew.h>
#include <vtkXMLDataElement.h>

#include <fstream>
#include <sstream>

#include "companion_folder.h"
#include "quadrille/atomic_file.h"
#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/picture_layers.h"
#include "vtk_data_file.h"
#include "vtk_scene_data.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

/// The pieces of a multi-block data set: written one after the other, so that only one of them is
/// in memory as VTK's data, and listed for the index.
class Pieces {
 public:
  Pieces(const Scene& scene, const CompanionFolder& folder, const fs::path& target,
         const RunContext& context)
      : scene_(scene), folder_(folder), target_(target), context_(context) {
    for (const SceneGroup& group : scene.groups) count_ += group.layers.size();
    blocks_->SetName("vtkMultiBlockDataSet");
  }

  void write() {
    for (const SceneGroup& group : scene_.groups) {
      vtkNew<vtkXMLDataElement> block;
      block->SetName("Block");
      block->SetIntAttribute("index", blocks_->GetNumberOfNestedElements());
      block->SetAttribute("name", group.name.c_str());
      for (const SceneLayer& layer : group.layers) write_layer(group, layer, block);
      blocks_->AddNestedElement(block);
    }
  }

  std::string index() const {
    vtkNew<vtkXMLDataElement> root;
    root->SetName("VTKFile");
    root->SetAttribute("type", "vtkMultiBlockDataSet");
    root->SetAttribute("version", "1.0");
    root->SetAttribute("byte_order", "LittleEndian");
    root->SetAttribute("header_type", "UInt64");
    root->AddNestedElement(blocks_);
    std::ostringstream text;
    text << "<?xml version=\"1.0\"?>\n";
    root->PrintXML(text, vtkIndent());
    return text.str();
  }

 private:
  void write_layer(const SceneGroup& group, const SceneLayer& layer, vtkXMLDataElement* block) {
    const RunContext part = part_context();
    const auto data = scene_data(layer, scene_.height, part);
    const std::string file = group.name + "_" + layer.name + data_file_ending(data);
    write_data_file(data, folder_.temporary() / file, target_, "vtm", part);
    vtkNew<vtkXMLDataElement> entry;
    entry->SetName("DataSet");
    entry->SetIntAttribute("index", block->GetNumberOfNestedElements());
    entry->SetAttribute("name", layer.name.c_str());
    entry->SetAttribute("file", (folder_.target().filename() / file).c_str());
    block->AddNestedElement(entry);
    ++done_;
  }

  /// The layer's share of the progress of the whole.
  RunContext part_context() const {
    RunContext part = context_;
    part.on_stage = nullptr;
    if (context_.on_progress) {
      part.on_progress = [this](const std::string&, double fraction) {
        return context_.on_progress("vtm", (done_ + fraction) / count_);
      };
    }
    return part;
  }

  const Scene& scene_;
  const CompanionFolder& folder_;
  const fs::path& target_;
  const RunContext& context_;
  double count_ = 0, done_ = 0;
  vtkNew<vtkXMLDataElement> blocks_;
};

}  // namespace

void write_vtm(const Scene& scene, const fs::path& path, const RunContext& context) {
  write_atomically(path, [&](const fs::path& temporary) {
    const CompanionFolder folder(temporary, path, "_vtm");
    std::error_code error;
    if (!fs::create_directory(folder.temporary(), error)) {
      throw Error(ErrorCode::io_failure, "cannot write '" + path.string() +
                                             "': the folder takes no new folder; choose another "
                                             "path");
    }
    Pieces pieces(scene, folder, path, context);
    pieces.write();
    std::ofstream file(temporary, std::ios::binary);
    file << pieces.index();
    file.close();
    if (!file) {
      throw Error(ErrorCode::io_failure,
                  "cannot write '" + path.string() +
                      "': not all bytes arrived; check the free space of the disk");
    }
    folder.keep();
  });
  context.progress("vtm", 1);
}

}  // namespace quadrille
