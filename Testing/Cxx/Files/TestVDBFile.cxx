// Validation of a .vdb file before OpenVDB reads it.

#include "Support/OutputFiles.h"
#include "Support/Throws.h"

#include "VDBFile.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointCount.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestVDBFile
{

namespace
{

std::string WriteTwoGrids(std::uint32_t compression = openvdb::io::COMPRESS_BLOSC)
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
  openvdb::io::File file(name);
  file.setCompression(compression | openvdb::io::COMPRESS_ACTIVE_MASK);
  file.write({ floats, vectors });
  return name;
}

constexpr int NumberOfPoints = 1000;

// The first byte of the positions is 1. This byte must not be read as the flag for compression.
std::string WritePoints(std::uint32_t compression = openvdb::io::COMPRESS_BLOSC)
{
  using namespace openvdb::points;
  openvdb::initialize();
  std::vector<openvdb::Vec3s> positions;
  for (int i = 0; i < NumberOfPoints; ++i)
  {
    positions.emplace_back(std::nextafter(0.25f, 1.f), 0.25f, static_cast<float>(i % 7));
  }
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  const auto grid = createPointDataGrid<NullCodec, PointDataGrid>(positions, *transform);
  appendAttribute<int>(grid->tree(), "number");
  AttributeWriteHandle<int> numbers(grid->tree().beginLeaf()->attributeArray("number"));
  for (int i = 0; i < NumberOfPoints; ++i)
  {
    numbers.set(i, i);
  }
  const std::string name = OutputName("points.vdb");
  openvdb::io::File file(name);
  file.setCompression(compression | openvdb::io::COMPRESS_ACTIVE_MASK);
  file.write({ grid });
  return name;
}

std::string ReadBytes(const std::string& name)
{
  std::ostringstream bytes;
  bytes << std::ifstream(name, std::ios::binary).rdbuf();
  return bytes.str();
}

template <class Number>
std::string BytesOf(Number number)
{
  return std::string(reinterpret_cast<const char*>(&number), sizeof number);
}

void CheckRefused(const std::string& bytes, const std::string& words)
{
  const std::string name = OutputName("damaged.vdb");
  std::ofstream(name, std::ios::binary) << bytes;
  EXPECT_TRUE(Throws<std::runtime_error>([&] { ValidateVDB(name); }, words)) << words;
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

// A value of 4 bytes is too short for compression, so its stored length is -4. The test changes
// this length to -3.
TEST(TestVDBFile, ValuesThatAreTooFewAreRefused)
{
  std::string bytes = ReadBytes(WriteTwoGrids(openvdb::io::COMPRESS_ZIP));
  const auto place = bytes.find(BytesOf(std::int64_t(-4)) + BytesOf(-3.f));
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, sizeof(std::int64_t), BytesOf(std::int64_t(-3)));
  CheckRefused(bytes, "values are missing");
}

// The compressed positions declare their size twice: before all pages and in their own head.
TEST(TestVDBFile, PagesOfPointsThatTellTwoSizesAreRefused)
{
  std::string bytes = ReadBytes(WritePoints());
  const auto unpacked = bytes.find(BytesOf(std::int32_t(3 * sizeof(float) * NumberOfPoints)));
  ASSERT_NE(unpacked, std::string::npos);
  const std::string stored = bytes.substr(unpacked - sizeof(std::int32_t), sizeof(std::int32_t));
  ++bytes[bytes.rfind(stored)];
  CheckRefused(bytes, "compressed values have a wrong size");
}

// Uncompressed points are in no page, unlike compressed ones.
TEST(TestVDBFile, PointsThatAreNotPackedAreRead)
{
  const std::string name = WritePoints(openvdb::io::COMPRESS_NONE);
  const VDBFile file = ValidateVDB(name);
  using openvdb::points::PointDataGrid;
  const auto grid = openvdb::gridPtrCast<PointDataGrid>(ReadVDBGrid(name, file.Grids.at(0)));
  ASSERT_TRUE(grid);
  EXPECT_EQ(openvdb::points::pointCount(grid->tree()), openvdb::Index64(NumberOfPoints));
}

TEST(TestVDBFile, MissingFilesAreErrorsThatNameThem)
{
  EXPECT_TRUE(Throws<std::runtime_error>([] { ValidateVDB("/none/a.vdb"); }, "/none/a.vdb"));
}

}
