// Thousands of damaged EXR files: each is read, or refused with one error message, an ErrorCode and
// an empty output. Memory and time stay limited, whatever a damaged header claims.

#include "IO/EXRFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"

#include "vtkActiveEXRReader.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestEXRFuzz
{

constexpr int Rounds = 150; // of each mutation, for each kind of file

using Bytes = std::vector<char>;

struct Fuzzed
{
  int Read = 0, Refused = 0;
};

std::vector<std::pair<std::string, Bytes>> MakeFiles()
{
  std::vector<std::pair<std::string, Bytes>> files;
  const auto add = [&files](const std::string& name, const auto& write)
  {
    const std::string path = OutputName("fuzz_" + name + ".exr");
    write(path);
    files.emplace_back(name, ReadBytes(path));
  };
  const auto kind = [](const KindOfFile& which)
  { return [which](const std::string& path) { WriteKind(path, which); }; };
  KindOfFile tiled, mipMaps, plain, piz, rle;
  tiled.Tiled = true;
  mipMaps.Tiled = mipMaps.MipMaps = true;
  plain.Compression = 0;
  rle.Compression = 1;
  piz.Compression = 4;
  add("zip", kind({}));
  add("plain", kind(plain));
  add("rle", kind(rle));
  add("piz", kind(piz));
  add("tiled", kind(tiled));
  add("mipmaps", kind(mipMaps));
  add("parts", WriteTwoParts);
  add("chroma", WriteLuminanceChroma);
  add("deep", WriteDeep);
  return files;
}

void TryBytes(vtkActiveEXRReader* reader, MessageCapture& messages, const Bytes& bytes,
  const std::string& what, Fuzzed& fuzzed)
{
  messages.Errors.clear();
  reader->SetMemoryBuffer(bytes.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(bytes.size()));
  reader->Modified();
  reader->Update();
  const vtkIdType points = reader->GetOutput()->GetNumberOfPoints();
  if (messages.Errors.empty())
  {
    ++fuzzed.Read;
    const bool whole = points > 0 && reader->GetErrorCode() == vtkErrorCode::NoError &&
      reader->GetOutput()->GetPointData()->GetNumberOfArrays() > 0;
    if (!whole)
    {
      ADD_FAILURE() << what << " is read without an error, and nothing is there";
    }
    return;
  }
  ++fuzzed.Refused;
  const bool told =
    messages.Errors.size() == 1 && messages.Errors[0].find("Cannot read") != std::string::npos;
  if (!told || reader->GetErrorCode() == vtkErrorCode::NoError || points != 0 ||
    reader->GetOutput()->GetPointData()->GetNumberOfArrays() != 0)
  {
    ADD_FAILURE() << what << " is refused by " << messages.Errors.size() << " errors, code "
                  << reader->GetErrorCode() << ", and leaves " << points
                  << " points: " << messages.Errors[0];
  }
}

std::size_t Below(std::mt19937& random, std::size_t limit)
{
  return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
}

void FlipBits(Bytes& bytes, std::mt19937& random)
{
  for (std::size_t i = 0; i < 1 + Below(random, 4); ++i)
  {
    bytes[Below(random, bytes.size())] ^= static_cast<char>(1 << Below(random, 8));
  }
}

void Truncate(Bytes& bytes, std::mt19937& random)
{
  bytes.resize(Below(random, bytes.size()));
}

// Replaces four bytes by a number that challenges checks of sizes.
void EditNumber(Bytes& bytes, std::mt19937& random)
{
  constexpr std::uint32_t numbers[] = { 0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000, 0x100000,
    0x3fffffff, 1000, 19 };
  const std::size_t end =
    Below(random, 2) ? std::min<std::size_t>(bytes.size(), 450) : bytes.size();
  const std::uint32_t number = numbers[Below(random, std::size(numbers))];
  for (std::size_t i = 0, at = Below(random, end - 4); i < 4; ++i)
  {
    bytes[at + i] = static_cast<char>(number >> 8 * i);
  }
}

void MoveBytes(Bytes& bytes, std::mt19937& random)
{
  const auto at = static_cast<std::ptrdiff_t>(Below(random, bytes.size()));
  if (Below(random, 2))
  {
    bytes.insert(bytes.begin() + at, static_cast<char>(random()));
  }
  else
  {
    bytes.erase(bytes.begin() + at);
  }
}

using Mutation = void (*)(Bytes&, std::mt19937&);

void Fuzz(const std::string& what, Mutation mutate, int rounds)
{
  vtkNew<vtkActiveEXRReader> reader;
  MessageCapture messages(reader);
  for (const auto& [name, original] : MakeFiles())
  {
    Fuzzed fuzzed;
    std::mt19937 random(static_cast<unsigned>(original.size()));
    for (int i = 0; i < rounds; ++i)
    {
      Bytes bytes = original;
      mutate(bytes, random);
      TryBytes(reader, messages, bytes, name + ", " + what + " " + std::to_string(i), fuzzed);
      if (name != "deep" && i % 16 == 0) // a previous output that could remain
      {
        Fuzzed whole;
        TryBytes(reader, messages, original, name + ", whole", whole);
        EXPECT_EQ(whole.Read, 1) << name << " is read";
      }
    }
    EXPECT_EQ(fuzzed.Read + fuzzed.Refused, rounds) << what << " of " << name;
    EXPECT_TRUE(fuzzed.Refused > 0) << what << " of " << name << " is refused at times";
  }
}

TEST(TestEXRFuzz, FlippedBitsAreReadOrRefused)
{
  Fuzz("flipped bits", FlipBits, 2 * Rounds);
}

TEST(TestEXRFuzz, TruncatedFilesAreReadOrRefused)
{
  Fuzz("truncation", Truncate, Rounds);
}

TEST(TestEXRFuzz, EditedSizesAreReadOrRefused)
{
  Fuzz("edited number", EditNumber, 2 * Rounds);
}

TEST(TestEXRFuzz, MovedBytesAreReadOrRefused)
{
  Fuzz("moved bytes", MoveBytes, Rounds);
}

TEST(TestEXRFuzz, EachByteOfTheHeaderIsReadOrRefused)
{
  const std::clock_t begin = std::clock(); // processor time, independent of other load
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  vtkNew<vtkActiveEXRReader> reader;
  MessageCapture messages(reader);
  Fuzzed fuzzed;
  for (const auto& [name, original] : MakeFiles())
  {
    for (std::size_t i = 0; i < std::min<std::size_t>(original.size(), 400); ++i)
    {
      for (const char byte : { '\xff', '\x7f' })
      {
        Bytes bytes = original;
        bytes[i] = byte;
        TryBytes(reader, messages, bytes, name + ", byte " + std::to_string(i), fuzzed);
      }
    }
  }
  getrusage(RUSAGE_SELF, &after);
  EXPECT_TRUE(fuzzed.Refused > 1000) << "most are refused";
  EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 60.0) << "seconds";
  EXPECT_LT((after.ru_maxrss - before.ru_maxrss) / 1024.0, 256.0) << "MiB more than before";
}

}
