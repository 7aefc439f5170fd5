// What is in a .vdb file, before OpenVDB reads it.

#include "Support/OutputFiles.h"
#include "Support/Throws.h"

#include "VDBFile.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

using namespace activesurface;

namespace
{

// Three voxels in two leaves, and a box of vectors.
std::string WriteTwoGrids()
{
  openvdb::initialize();
  auto floats = openvdb::FloatGrid::create(3.f);
  floats->setName("floats");
  floats->tree().setValue({ 1, 2, 3 }, -1.f);
  floats->tree().setValue({ 1, 2, 4 }, -2.f);
  floats->tree().setValue({ 1, 2, 9 }, -3.f);
  auto vectors = openvdb::Vec3SGrid::create();
  vectors->setName("vectors");
  vectors->denseFill({ { 0, 0, 0 }, { 3, 3, 3 } }, openvdb::Vec3s(1.f));
  const std::string name = OutputName("two.vdb");
  openvdb::io::File(name).write({ floats, vectors });
  return name;
}

}

TEST(TestVDBFile, GridsAreToldWithTheirTrees)
{
  const VDBFile file = ValidateVDB(WriteTwoGrids());
  ASSERT_EQ(file.Grids.size(), 2u);
  EXPECT_EQ(file.Grids[0].Name, "floats");
  EXPECT_STREQ(file.Grids[0].GetValueType(), "float");
  EXPECT_TRUE(file.Grids[0].IsKnown);
  EXPECT_EQ(file.Grids[0].ActiveVoxels, 3u);
  EXPECT_EQ(file.Grids[0].NumberOfLeaves, 2u);
  EXPECT_EQ(file.Grids[0].ActiveBox, openvdb::CoordBBox(1, 2, 3, 1, 2, 9));
  EXPECT_EQ(file.Grids[1].Name, "vectors");
  EXPECT_STREQ(file.Grids[1].GetValueType(), "vec3s");
  EXPECT_EQ(file.Grids[1].ActiveVoxels, 64u);
}

TEST(TestVDBFile, GridsAreReadAsTheyWereWritten)
{
  const std::string name = WriteTwoGrids();
  const VDBFile file = ValidateVDB(name);
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(ReadVDBGrid(name, file.Grids.at(0)));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->background(), 3.f);
  EXPECT_EQ(grid->tree().getValue({ 1, 2, 9 }), -3.f);
  EXPECT_EQ(grid->activeVoxelCount(), 3u);
}

// At each length, by steps of a prime: wherever it ends, in the header, in a topology, in values.
TEST(TestVDBFile, FilesThatAreCutShortAreRefused)
{
  const std::string name = WriteTwoGrids();
  const auto size = std::filesystem::file_size(name);
  ASSERT_GT(size, 100u);
  const std::string cut = OutputName("cut.vdb");
  for (std::uintmax_t length = 0; length < size; length += 17)
  {
    std::filesystem::copy_file(name, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, length);
    EXPECT_TRUE(Throws<std::runtime_error>([&] { ValidateVDB(cut); }, "cut.vdb"))
      << length << " of " << size << " bytes";
  }
}

TEST(TestVDBFile, MissingFilesAreErrorsThatNameThem)
{
  EXPECT_TRUE(Throws<std::runtime_error>([] { ValidateVDB("/none/a.vdb"); }, "/none/a.vdb"));
}
