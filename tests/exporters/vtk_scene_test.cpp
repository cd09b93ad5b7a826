#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/error.h"
#include "quadrille/export.h"
#include "quadrille/picture_layers.h"
#include "quadrille/render.h"
#include "quadrille/stage_layers.h"
#include "support/programs.h"
#include "support/python_with_vtk.h"
#include "support/random_patches.h"

namespace quadrille {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = test::scratch_dir() / ("scene_" + name);
  fs::remove_all(folder);
  fs::create_directory(folder);
  return folder;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

VectorImage random_picture() {
  PatchMesh patches = testing::random_patches(4, 3, 40, 30, 5);
  testing::set_random_colors(patches, 6);
  return single_layer(std::move(patches), 40, 30);
}

Scene scene_with_all_stages() {
  Raster picture(40, 30, 3);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = x + y < 30 ? 0.2f : 0.8f;
    }
  }
  VectorizeOptions options;
  options.quads = 60;
  Quadrangulation stages;
  auto image = std::make_shared<const VectorImage>(vectorize(picture, options, {}, &stages).image);
  Scene scene{40, 30, {picture_group(image, &picture)}};
  for (const SceneStage& stage : scene_stages()) {
    scene.groups.push_back({stage.name, stage.summary, stage.layers(stages, 0.25)});
  }
  return scene;
}

json blocks_of(const fs::path& path) {
  std::string output;
  const std::string script = QUADRILLE_SOURCE_DIR "/tests/programs/read_vtm.py";
  const int status = test::run({test::python_with_vtk(), script, path.string()}, &output);
  EXPECT_EQ(status, 0) << output;
  return status == 0 ? json::parse(output) : json();
}

TEST(VtkScene, OpensWithAllLayersAndTheirArrays) {
  const fs::path folder = fresh_folder("layers");
  const Scene scene = scene_with_all_stages();
  write_vtm(scene, folder / "a.vtm");
  const json blocks = blocks_of(folder / "a.vtm");
  std::size_t count = 0;
  for (const SceneGroup& group : scene.groups) {
    for (const SceneLayer& layer : group.layers) {
      SCOPED_TRACE(group.name + "/" + layer.name);
      ++count;
      ASSERT_TRUE(blocks.contains(group.name + "/" + layer.name));
      const json& block = blocks[group.name + "/" + layer.name];
      const auto expect_arrays = [&](const std::vector<SceneArray>& arrays, const char* where) {
        for (const SceneArray& array : arrays) {
          EXPECT_THAT(block[where], ::testing::Contains(array.name));
          EXPECT_EQ(block["meanings"][array.name], array.meaning);
        }
      };
      EXPECT_THAT(block["field_arrays"], ::testing::Contains("summary"));
      if (const auto* grid = std::get_if<SceneGrid>(&layer.content)) {
        EXPECT_EQ(block["class"], "vtkImageData");
        EXPECT_EQ(block["cells"], grid->width * grid->height);
        const std::vector<double> bounds = block["bounds"];
        EXPECT_THAT(bounds, ::testing::Pointwise(::testing::DoubleNear(1e-9),
                                                 std::vector<double>{0, 40, 0, 30, 0, 0}));
        expect_arrays(grid->arrays, "cell_arrays");
      } else if (const auto* shapes = std::get_if<SceneShapes>(&layer.content)) {
        EXPECT_EQ(block["class"], "vtkPolyData");
        EXPECT_EQ(block["points"], shapes->points.size());
        EXPECT_EQ(block["cells"], shapes->cell == SceneShapes::Cell::point
                                      ? shapes->points.size()
                                      : std::size_t(shapes->cell_count()));
        expect_arrays(shapes->point_arrays, "point_arrays");
        expect_arrays(shapes->cell_arrays, "cell_arrays");
      } else {
        EXPECT_EQ(block["class"], "vtkUnstructuredGrid");
        for (const char* name : {"patch", "layer", "region", "fitting_error", "scaled_jacobian",
                                 "valence", "corner_vertices", "corner_wedges"}) {
          EXPECT_THAT(block["cell_arrays"], ::testing::Contains(name));
        }
      }
    }
  }
  EXPECT_EQ(blocks.size(), count);
}

TEST(VtkScene, HoldsThePatchesAsReadVtuTakesThem) {
  const fs::path folder = fresh_folder("patches");
  const VectorImage image = random_picture();
  export_image(image, folder / "a.vtm");
  const VectorImage read = read_vtu(folder / "a_vtm" / "picture_patches.vtu");
  EXPECT_TRUE(to_document(read) == to_document(image));
}

TEST(VtkScene, IsReadBack) {
  const fs::path folder = fresh_folder("read");
  for (const bool alpha : {false, true}) {
    Raster picture(40, 30, alpha ? 4 : 3);
    for (std::size_t i = 0; i < picture.data.size(); ++i) {
      picture.data[i] = static_cast<float>(i * 37 % 256) / 255;
    }
    const auto image = std::make_shared<const VectorImage>(random_picture());
    write_vtm({40, 30, {picture_group(image, &picture)}}, folder / "a.vtm");
    DocumentOptions lossless;
    lossless.encoding = DocumentEncoding::lossless;
    EXPECT_TRUE(to_document(import_image(folder / "a.vtm"), lossless) ==
                to_document(*image, lossless));
    const std::optional<Raster> source = import_source(folder / "a.vtm");
    ASSERT_TRUE(source);
    EXPECT_EQ(*source, picture);
  }
  export_image(random_picture(), folder / "b.vtm");
  EXPECT_EQ(import_source(folder / "b.vtm"), std::nullopt);
  EXPECT_EQ(import_source(folder / "b.quad"), std::nullopt);
}

ErrorCode error_of_reading(const fs::path& path) {
  try {
    read_vtm(path);
    read_vtm_source(path);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(path.stem().string()));
    return error.code();
  }
  ADD_FAILURE() << path << " was read";
  return {};
}

/// A fresh folder with a scene file, a.vtm, of random patches and a picture of 40 x 30 pixels.
fs::path folder_with_scene(const std::string& name) {
  const fs::path folder = fresh_folder(name);
  const Raster picture(40, 30, 3);
  write_vtm(
      {40, 30, {picture_group(std::make_shared<const VectorImage>(random_picture()), &picture)}},
      folder / "a.vtm");
  return folder;
}

TEST(VtkScene, RefusesToReadWhatIsNotItsOwn) {
  const fs::path folder = folder_with_scene("foreign_index");
  EXPECT_EQ(error_of_reading(folder / "none.vtm"), ErrorCode::io_failure);
  const auto expect_refused = [&](const std::string& index, ErrorCode code) {
    std::ofstream(folder / "b.vtm") << index;
    EXPECT_EQ(error_of_reading(folder / "b.vtm"), code) << index;
  };
  const std::string head = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>";
  expect_refused("", ErrorCode::unsupported_format);
  expect_refused("<VTKFile type=\"PolyData\"/>", ErrorCode::unsupported_format);
  expect_refused(head + "</vtkMultiBlockDataSet></VTKFile>", ErrorCode::unsupported_format);
  expect_refused(head, ErrorCode::io_failure);
  const auto expect_refused_piece = [&](const std::string& name, ErrorCode code) {
    expect_refused(head + "<Block name=\"picture\"><DataSet name=\"patches\" file=\"" + name +
                       "\"/></Block></vtkMultiBlockDataSet></VTKFile>",
                   code);
  };
  for (const char* outside : {"/dev/zero", "../foreign_index/a_vtm/picture_patches.vtu", "..",
                              "a_vtm/../a_vtm/picture_patches.vtu"}) {
    expect_refused_piece(outside, ErrorCode::unsupported_format);
  }
  ASSERT_EQ(mkfifo((folder / "b_pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder / "b_zero");
  fs::create_symlink("b_loop", folder / "b_loop");
  fs::create_directory(folder / "b_folder");
  for (const std::string& unreadable :
       {std::string("b_pipe"), std::string("b_zero"), std::string("b_loop"),
        std::string("b_folder"), std::string("b_none.vtu"), std::string(300, 'b')}) {
    expect_refused_piece(unreadable, ErrorCode::io_failure);
  }

  const fs::path pixels = folder / "a_vtm" / "picture_picture.vti";
  const std::string bytes = bytes_of(pixels);
  for (const char* extent : {"0 41 0 30 0 0", "0 -1 0 30 0 0", "1 40 0 30 0 0", "0 40 0 30", "",
                             "0 4000000000 0 4000000000 0 0", "0 0 0 0 0 0"}) {
    SCOPED_TRACE(extent);
    std::string other = bytes;
    const auto at = other.find("<Piece Extent=\"") + 15;
    other.replace(at, other.find('"', at) - at, extent);
    std::ofstream(pixels, std::ios::binary) << other;
    EXPECT_THROW(read_vtm_source(folder / "a.vtm"), Error);
  }
  fs::remove(pixels);
  EXPECT_EQ(error_of_reading(folder / "a.vtm"), ErrorCode::io_failure);
}

TEST(VtkScene, RefusesWhatIsTooLargeBeforeReadingIt) {
  const fs::path folder = folder_with_scene("large");
  const fs::path pixels = folder / "a_vtm" / "picture_picture.vti";
  std::string bytes = bytes_of(pixels);
  const auto at = bytes.find("<Piece Extent=\"") + 15;
  bytes.replace(at, bytes.find('"', at) - at, "0 20000 0 15001 0 0");
  std::ofstream(pixels, std::ios::binary) << bytes;
  EXPECT_EQ(error_of_reading(folder / "a.vtm"), ErrorCode::limit_exceeded);

  fs::resize_file(folder / "a.vtm", 5'000'000'000);  // of which the disk holds none
  EXPECT_EQ(error_of_reading(folder / "a.vtm"), ErrorCode::limit_exceeded);
}

TEST(VtkScene, RefusesPixelsThatClaimMoreBytesThanTheyTake) {
  const fs::path folder = folder_with_scene("claim");
  const fs::path pixels = folder / "a_vtm" / "picture_picture.vti";
  std::string bytes = bytes_of(pixels);
  ASSERT_NE(bytes.find("header_type=\"UInt64\""), std::string::npos);
  const auto offset = bytes.find("offset=\"", bytes.find("Name=\"rgb\"")) + 8;
  const auto blocks =
      bytes.find('_', bytes.find("<AppendedData")) + 1 + std::stoul(bytes.substr(offset));
  // Numbers of blocks, of bytes of each, and of bytes of a last partial one.
  std::array<std::uint64_t, 3> sizes = {};
  std::memcpy(sizes.data(), bytes.data() + blocks, sizeof sizes);
  ASSERT_EQ(sizes[0], 1);
  ASSERT_EQ(sizes[2], 40 * 30 * 3);
  ++sizes[2];
  std::memcpy(bytes.data() + blocks, sizes.data(), sizeof sizes);
  std::ofstream(pixels, std::ios::binary) << bytes;
  try {
    read_vtm_source(folder / "a.vtm");
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io_failure);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("wrong size"));
  }
}

TEST(VtkScene, SurfaceFacesTheViewer) {
  const fs::path folder = fresh_folder("surface");
  write_vtp(random_picture(), folder / "a.vtp");
  std::string output;
  const int status =
      test::run({test::python_with_vtk(), "-c",
                 "import sys; from vtkmodules.vtkIOXML import vtkXMLPolyDataReader as R\n"
                 "r = R(); r.SetFileName(sys.argv[1]); r.Update(); d = r.GetOutput()\n"
                 "def area(c):\n"
                 "  p = [c.GetPoints().GetPoint(i) for i in range(4)]\n"
                 "  return sum(p[i][0]*p[(i+1)%4][1]-p[(i+1)%4][0]*p[i][1] for i in range(4))/2\n"
                 "a = [area(d.GetCell(i)) for i in range(d.GetNumberOfCells())]\n"
                 "print(len(a), min(a) > 0, round(sum(a), 6))",
                 (folder / "a.vtp").string()},
                &output);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(output, std::to_string(12 * 16) + " True 1200.0\n");
}

TEST(VtkScene, ReplacesAFormerFileWithItsPieces) {
  const fs::path folder = fresh_folder("again");
  write_vtm(scene_with_all_stages(), folder / "a.vtm");
  export_image(random_picture(), folder / "a.vtm");
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("a.vtm", "a_vtm"));
  EXPECT_EQ(names_in(folder / "a_vtm").size(), 6);
}

TEST(VtkScene, LeavesAForeignFolderAlone) {
  const fs::path folder = fresh_folder("foreign");
  fs::create_directory(folder / "a_vtm");
  EXPECT_THROW(export_image(random_picture(), folder / "a.vtm"), Error);
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("a_vtm"));
}

TEST(VtkScene, LeavesNothingBehindWhenCancelledAnywhere) {
  const VectorImage image = random_picture();
  for (const char* ending : {".vtu", ".vtp", ".vtm"}) {
    SCOPED_TRACE(ending);
    int reports = 0;
    RunContext counting;
    counting.on_progress = [&](const std::string&, double fraction) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1);
      ++reports;
      return true;
    };
    const fs::path folder = fresh_folder("cancelled");
    export_image(image, folder / (std::string("whole") + ending), {}, counting);
    const std::vector<std::string> before = names_in(folder);
    // The last report comes when the file is there.
    for (int stop = 1; stop < reports; ++stop) {
      int left = stop;
      RunContext context;
      context.on_progress = [&](const std::string&, double) { return --left > 0; };
      try {
        export_image(image, folder / (std::string("part") + ending), {}, context);
        FAIL() << "not cancelled at report " << stop;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
      }
      EXPECT_EQ(names_in(folder), before);
    }
  }
}

TEST(VtkScene, IsTheSameForAnyThreadCount) {
  const Scene scene = scene_with_all_stages();
  const fs::path folder = fresh_folder("threads");
  RunContext three;
  three.threads = 3;
  write_vtm(scene, folder / "a.vtm");
  fs::rename(folder / "a_vtm", folder / "before");
  fs::rename(folder / "a.vtm", folder / "before.vtm");
  write_vtm(scene, folder / "a.vtm", three);
  EXPECT_TRUE(bytes_of(folder / "a.vtm") == bytes_of(folder / "before.vtm"));
  for (const std::string& name : names_in(folder / "before")) {
    EXPECT_TRUE(bytes_of(folder / "before" / name) == bytes_of(folder / "a_vtm" / name)) << name;
  }
}

}  // namespace
}  // namespace quadrille
