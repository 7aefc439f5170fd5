// Thousands of damaged .vdb files: each is read, or refused with an error message and an empty
// output. A crash, a hang or an unbounded allocation fails the test.

#include "IO/GridFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"

#include "vtkDataObject.h"
#include "vtkDataSet.h"

#include <gtest/gtest.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointGroup.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestVDBDamage
{

// OpenVDB leaks some bytes for each page of attributes if it fails to read points.
extern "C" const char* __lsan_default_suppressions()
{
  return "leak:PagedInputStream::createHandle\nleak:compression::Page::";
}

namespace
{

constexpr int MutationsOfEach = 300;

std::string Write(const openvdb::GridPtrVec& grids, std::uint32_t compression)
{
  const std::string name = OutputName("vdb_whole.vdb");
  openvdb::initialize();
  openvdb::io::File out(name);
  out.setCompression(compression);
  out.write(grids);
  return ReadFile(name);
}

openvdb::FloatGrid::Ptr MakeBallGrid()
{
  auto ball =
    openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(0.4f, openvdb::Vec3f(0.f), 0.125f);
  ball->setName("ball");
  ball->insertMeta("text", openvdb::StringMetadata("some words"));
  return ball;
}

openvdb::GridBase::Ptr MakePointGrid()
{
  using namespace openvdb::points;
  std::vector<openvdb::Vec3s> positions;
  std::vector<int> ids;
  for (int i = 0; i < 200; ++i)
  {
    positions.emplace_back(std::sin(0.1f * i), std::cos(0.13f * i), 0.01f * i);
    ids.push_back(i);
  }
  const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
  const PointAttributeVector<openvdb::Vec3s> places(positions);
  using Index = openvdb::tools::PointIndexGrid;
  const auto index = openvdb::tools::createPointIndexGrid<Index>(places, *transform);
  auto grid = createPointDataGrid<NullCodec, PointDataGrid>(*index, places, *transform);
  appendAttribute<int>(grid->tree(), "id");
  populateAttribute(grid->tree(), index->tree(), "id", PointAttributeVector<int>(ids));
  appendAttribute<float>(grid->tree(), "same", 1.f);
  appendGroup(grid->tree(), "chosen");
  grid->setName("points");
  return grid;
}

// Mutates the head of the file more often than the rest.
std::string Mutate(const std::string& whole, std::mt19937& random)
{
  std::string bytes = whole;
  const auto below = [&](std::size_t n)
  { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const std::size_t place =
    below(2) ? below(bytes.size()) : below(std::min<std::size_t>(1500, bytes.size()));
  switch (below(6))
  {
    case 0:
    case 1:
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(8)));
      break;
    case 2:
      for (int i = 0; i < 8; ++i)
      {
        char& byte = bytes[below(bytes.size())];
        byte = static_cast<char>(byte ^ (1 << below(8)));
      }
      break;
    case 3:
      bytes.resize(place);
      break;
    case 4:
      bytes.insert(place, bytes.substr(below(bytes.size()), 1 + below(64)));
      break;
    default:
    {
      const std::uint32_t sizes[] = { 0, 1, 0x7fffffff, 0xffffffff, 0x80000000, 0x10000 };
      const std::uint32_t size = sizes[below(6)];
      bytes.replace(place, std::min<std::size_t>(4, bytes.size() - place),
        reinterpret_cast<const char*>(&size), std::min<std::size_t>(4, bytes.size() - place));
    }
  }
  return bytes;
}

struct Outcome
{
  int Read = 0;
  int Refused = 0;
  int Silent = 0; // neither read nor refused
};

void ReadOne(const std::string& name, Outcome& outcome)
{
  vtkNew<vtkActiveVDBReader> reader;
  reader->SetMaximumNumberOfPoints(1000000);
  const MessageCapture errors(reader);
  reader->SetFileName(name.c_str());
  reader->Update();
  auto data = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  const bool isEmpty = !data || data->GetNumberOfPoints() == 0;
  outcome.Read += errors.Errors.empty() ? 1 : 0;
  outcome.Refused += !errors.Errors.empty() && isEmpty && reader->GetErrorCode() != 0 ? 1 : 0;
  outcome.Silent += !errors.Errors.empty() && (!isEmpty || reader->GetErrorCode() == 0) ? 1 : 0;
}

void CheckMutations(const std::string& whole, const char* kind)
{
  const std::string name = OutputName("vdb_damaged_") + kind + ".vdb";
  std::mt19937 random(12345);
  Outcome outcome;
  for (int i = 0; i < MutationsOfEach; ++i)
  {
    std::ofstream(name, std::ios::binary) << Mutate(whole, random);
    ReadOne(name, outcome);
  }
  EXPECT_EQ(outcome.Silent, 0) << std::string(kind) << ": errors with data";
  EXPECT_EQ(outcome.Read + outcome.Refused, MutationsOfEach) << std::string(kind) << ": outcomes";
  EXPECT_LT(MutationsOfEach / 4, outcome.Refused) << std::string(kind) << ": refused";
  EXPECT_GT(outcome.Read, 0) << std::string(kind) << ": read, as only values differ";
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  // The worst case is some hundreds of MiB. The sanitizer keeps freed memory.
  EXPECT_LT(usage.ru_maxrss / 1024, 2000) << "largest memory [MiB]";
}

constexpr std::uint32_t Mask = openvdb::io::COMPRESS_ACTIVE_MASK;
constexpr std::uint32_t Blosc = Mask | openvdb::io::COMPRESS_BLOSC;
constexpr std::uint32_t Zip = Mask | openvdb::io::COMPRESS_ZIP;

}

TEST(TestVDBDamage, DamagedLevelSetsAreRefusedOrRead)
{
  CheckMutations(Write({ MakeBallGrid() }, Blosc), "blosc");
  CheckMutations(Write({ MakeBallGrid() }, 0), "plain");
}

TEST(TestVDBDamage, DamagedVectorsAndWholeNumbersAreRefusedOrRead)
{
  auto vectors = openvdb::Vec3SGrid::create();
  auto numbers = openvdb::Int32Grid::create(-1);
  auto flags = openvdb::BoolGrid::create();
  for (int i = 0; i < 300; ++i)
  {
    const openvdb::Coord place(i % 20, i / 20, 3 * i % 17);
    vectors->tree().setValue(place, openvdb::Vec3s(1.f * i));
    numbers->tree().setValue(place, i);
    flags->tree().setValue(place, i % 2 == 0);
  }
  vectors->tree().addTile(1, openvdb::Coord(64, 0, 0), openvdb::Vec3s(1.f), true);
  CheckMutations(Write({ vectors }, Zip), "vectors");
  CheckMutations(Write({ numbers }, Zip), "numbers");
  CheckMutations(Write({ flags }, Mask), "flags");
}

TEST(TestVDBDamage, DamagedPointsAreRefusedOrRead)
{
  openvdb::initialize();
  CheckMutations(Write({ MakePointGrid() }, Blosc), "points");
}

// OpenVDB's own reader aborts the program in this case.
TEST(TestVDBDamage, PointsWithABackgroundAreRefused)
{
  openvdb::initialize();
  std::string bytes = Write({ MakePointGrid() }, Blosc);
  // One buffer, the background 0, no tiles.
  const std::string root("\1\0\0\0\0\0\0\0\0\0\0\0", 12);
  const auto place = bytes.find(root, bytes.find("UniformScaleMap"));
  EXPECT_TRUE(place != std::string::npos) << "the root is found";
  bytes[place + 4] = 1;
  const std::string name = OutputName("vdb_background.vdb");
  std::ofstream(name, std::ios::binary) << bytes;
  Outcome outcome;
  ReadOne(name, outcome);
  EXPECT_EQ(outcome.Refused, 1) << "refused";
}

TEST(TestVDBDamage, DamagedSeveralGridsAreRefusedOrRead)
{
  auto ball = MakeBallGrid();
  auto half = MakeBallGrid();
  half->setSaveFloatAsHalf(true);
  auto same = ball->copy();
  same->setName("same");
  CheckMutations(Write({ half, ball, same }, Blosc), "several");
}

TEST(TestVDBDamage, TruncatedFilesAreRefused)
{
  const std::string whole = Write({ MakeBallGrid() }, Blosc);
  const std::string name = OutputName("vdb_cut.vdb");
  Outcome outcome;
  int cuts = 0;
  for (std::size_t size = 0; size < whole.size(); size += size < 400 ? 1 : 97)
  {
    std::ofstream(name, std::ios::binary) << whole.substr(0, size);
    ReadOne(name, outcome);
    ++cuts;
  }
  EXPECT_EQ(outcome.Refused, cuts) << "refused";
}

}
