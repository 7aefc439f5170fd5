#include "State/PackedBand.h"

#include "OpenVDB.h"
#include "State/SavedTree.h"

#include <openvdb/io/Compression.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <vector>

namespace activesurface
{

namespace
{

/** What is known of a leaf without its values. */
struct LeafBits
{
  std::int32_t Origin[4]; //< the last one 0: no byte is left unset
  LeafMask Inside;
  LeafMask Active;
};

/** Byte b of all magnitudes, one after the other: like with like, for compression. */
std::string BytePlane(const std::vector<float>& magnitudes, int b)
{
  std::string plane(magnitudes.size(), '\0');
  const char* bytes = reinterpret_cast<const char*>(magnitudes.data());
  for (std::size_t i = 0; i < magnitudes.size(); ++i)
  {
    plane[i] = bytes[4 * i + b];
  }
  return plane;
}

void WriteNumber(std::ostream& out, std::uint64_t number)
{
  out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

std::uint64_t ReadNumber(std::istream& in)
{
  std::uint64_t number = 0;
  in.read(reinterpret_cast<char*>(&number), sizeof number);
  return number;
}

void WriteZipped(std::ostream& out, const char* bytes, std::size_t size)
{
  openvdb::io::zipToStream(out, bytes, size);
}

constexpr int FirstZippedByte = 2; // of a little-endian float: sign, exponent and 7 bits follow

}

std::string PackBand(const LeafTable& table)
{
  std::vector<LeafBits> leaves;
  std::vector<float> magnitudes;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    const BandLeaf& leaf = table[i];
    if (!table.SummaryOf(i).IsUsed)
    {
      continue;
    }
    leaves.push_back(
      { { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2], 0 }, leaf.Inside, leaf.Active });
    leaf.Active.ForEach([&](int node) { magnitudes.push_back(std::fabs(leaf.Value[node])); });
  }
  std::ostringstream out;
  WriteNumber(out, leaves.size());
  WriteNumber(out, magnitudes.size());
  WriteZipped(out, reinterpret_cast<const char*>(leaves.data()), leaves.size() * sizeof(LeafBits));
  for (int b = 0; b < 4; ++b)
  {
    const std::string plane = BytePlane(magnitudes, b);
    if (b < FirstZippedByte)
    {
      out.write(plane.data(), static_cast<std::streamsize>(plane.size()));
    }
    else
    {
      WriteZipped(out, plane.data(), plane.size());
    }
  }
  return out.str();
}

namespace
{

// OpenVDB allocates as many bytes as the stream tells before it reads them, has errors of its own,
// and where the number is negative, as of bytes that zip to more, reads as many, whatever fits.
void Unzip(std::istream& in, char* data, std::size_t count)
{
  const std::istream::pos_type begin = in.tellg();
  openvdb::Int64 zipped = 0;
  in.read(reinterpret_cast<char*>(&zipped), sizeof zipped);
  const bool isAsItIs = zipped == -static_cast<openvdb::Int64>(count);
  if (!in || zipped > in.rdbuf()->in_avail() || (zipped <= 0 && !isAsItIs))
  {
    RefuseState();
  }
  in.seekg(begin);
  try
  {
    openvdb::io::unzipFromStream(in, data, count);
  }
  catch (const openvdb::Exception&)
  {
    RefuseState();
  }
}

std::vector<float> ReadMagnitudes(std::istream& in, std::size_t count)
{
  std::vector<float> magnitudes(count);
  std::string plane(count, '\0');
  char* bytes = reinterpret_cast<char*>(magnitudes.data());
  for (int b = 0; b < 4; ++b)
  {
    if (b < FirstZippedByte)
    {
      in.read(&plane[0], static_cast<std::streamsize>(count));
    }
    else
    {
      Unzip(in, &plane[0], count);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      bytes[4 * i + b] = plane[i];
    }
  }
  return magnitudes;
}

void FillLeaf(const LeafBits& bits, float background, const float*& magnitude, PotentialLeaf& leaf)
{
  float* value = leaf.buffer().data();
  for (int node = 0; node < 512; ++node)
  {
    const float size = bits.Active.Has(node) ? *magnitude++ : background;
    value[node] = bits.Inside.Has(node) ? -size : size;
  }
  leaf.setValuesOn(); // that flooding leaves it as it is
}

void SetActive(const LeafBits& bits, PotentialLeaf& leaf)
{
  PotentialLeaf::NodeMaskType mask;
  for (int x = 0; x < 8; ++x)
  {
    mask.getWord<std::uint64_t>(x) = bits.Active.Word[x];
  }
  leaf.setValueMask(mask);
}

std::vector<LeafBits> ReadLeaves(std::istream& in, std::size_t leafCount, std::size_t nodeCount)
{
  std::vector<LeafBits> leaves(leafCount);
  Unzip(in, reinterpret_cast<char*>(leaves.data()), leafCount * sizeof(LeafBits));
  std::size_t active = 0;
  for (const LeafBits& leaf : leaves)
  {
    active += leaf.Active.Count();
  }
  if (!in || active != nodeCount)
  {
    RefuseState();
  }
  return leaves;
}

}

openvdb::FloatTree::Ptr UnpackBand(const std::string& bytes, float background)
{
  std::istringstream in(bytes);
  const std::uint64_t leafCount = ReadNumber(in), nodeCount = ReadNumber(in);
  if (!in || leafCount > bytes.size() || nodeCount > bytes.size())
  {
    RefuseState();
  }
  const std::vector<LeafBits> leaves = ReadLeaves(in, leafCount, nodeCount);
  const std::vector<float> magnitudes = ReadMagnitudes(in, nodeCount);
  if (!in)
  {
    RefuseState();
  }
  auto tree = std::make_shared<openvdb::FloatTree>(background);
  const float* magnitude = magnitudes.data();
  const auto leafOf = [&tree](const LeafBits& bits)
  { return tree->touchLeaf(openvdb::Coord(bits.Origin[0], bits.Origin[1], bits.Origin[2])); };
  for (const LeafBits& bits : leaves)
  {
    FillLeaf(bits, background, magnitude, *leafOf(bits));
  }
  openvdb::tools::signedFloodFillWithValues(*tree, background, -background);
  for (const LeafBits& bits : leaves)
  {
    SetActive(bits, *leafOf(bits));
  }
  CheckTree(*tree);
  return tree;
}

}
