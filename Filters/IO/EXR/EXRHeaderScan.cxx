#include "EXR/EXRHeaderScan.h"

#include "Common/FileError.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfOpaqueAttribute.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace activesurface
{

namespace
{

[[noreturn]] void RefuseHeader(const std::string& fault)
{
  throw FileError(vtkErrorCode::FileFormatError, fault + "; copy or write it again");
}

char ReadByte(EXRInput& input)
{
  char byte = 0;
  input.read(&byte, 1);
  return byte;
}

std::uint32_t ReadNumber(EXRInput& input)
{
  unsigned char bytes[4];
  input.read(reinterpret_cast<char*>(bytes), 4);
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

std::string ReadName(EXRInput& input)
{
  constexpr std::size_t longest = 255;
  std::string name;
  while (const char byte = ReadByte(input))
  {
    name += byte;
    if (name.size() > longest)
    {
      RefuseHeader("a name in its header has no end");
    }
  }
  return name;
}

// Reads an attribute and checks its end. OpenEXR before 3.3 reads attributes of some types beyond
// their stated size, or not to their end. OpenEXR would then treat the following bytes as the next
// attribute, of any size.
void ReadAttribute(EXRInput& input, const std::string& name, int version, Imf::Header& header)
{
  const std::string type = ReadName(input);
  const std::uint32_t size = ReadNumber(input);
  const std::uint64_t end = input.tellg() + size;
  if (end > input.GetSize() || size > std::numeric_limits<int>::max())
  {
    RefuseHeader("attribute " + name + " of its header is larger than the rest of the file");
  }
  const std::unique_ptr<Imf::Attribute> attribute(Imf::Attribute::knownType(type.c_str())
      ? Imf::Attribute::newAttribute(type.c_str())
      : new Imf::OpaqueAttribute(type.c_str()));
  attribute->readValueFrom(input, static_cast<int>(size), version);
  if (input.tellg() != end)
  {
    RefuseHeader("attribute " + name + " of its header does not have the length that it declares");
  }
  header.insert(name, *attribute);
}

double CountPieces(double whole, double piece)
{
  return std::ceil(whole / std::max(1.0, piece));
}

int CountLinesOfChunk(Imf::Compression compression)
{
  switch (compression)
  {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    default:
      return 256; // DWAB; also a bound for compressions newer than this code
  }
}

// Returns the largest accepted ratio of unpacked to packed bytes: 1 without compression, else that
// of deflate. DWA, which deflates the means of blocks of 64 pixels, has 64 times this ratio; newer
// compressions count as DWA.
double FindLargestRatio(Imf::Compression compression)
{
  constexpr double deflate = 1032.0;
  return compression == Imf::NO_COMPRESSION ? 1.0
    : compression < Imf::DWAA_COMPRESSION   ? deflate
                                            : 64.0 * deflate;
}

// With this limit, sums and differences of three coordinates fit into an int.
void CheckWindow(const Imath::Box2i& window)
{
  constexpr int farthest = 1 << 29;
  for (const int x : { window.min.x, window.min.y, window.max.x, window.max.y })
  {
    if (x < -farthest || x > farthest)
    {
      RefuseHeader(
        "a window of its header reaches to pixel " + std::to_string(x) + ", beyond +-2^29");
    }
  }
}

double CountChunks(const Imf::Header& header, bool tiled, double width, double height)
{
  if (tiled && header.hasTileDescription())
  {
    const Imf::TileDescription& tile = header.tileDescription();
    return CountPieces(width, tile.xSize) * CountPieces(height, tile.ySize);
  }
  // OpenEXR uses chunkCount for parts of types that it does not know.
  const double stated = header.hasChunkCount() ? header.chunkCount() : 0.0;
  return std::max(stated, CountPieces(height, CountLinesOfChunk(header.compression())));
}

// Rejects more pixels than the file's bytes can contain. Every chunk has 8 bytes in a table.
void CheckSize(const Imf::Header& header, bool tiled, double fileSize)
{
  CheckWindow(header.dataWindow());
  CheckWindow(header.displayWindow());
  const Imath::Box2i& window = header.dataWindow();
  const double width = double(window.max.x) - window.min.x + 1.0;
  const double height = double(window.max.y) - window.min.y + 1.0;
  double bytes = 0.0;
  const Imf::ChannelList& channels = header.channels();
  for (auto i = channels.begin(); i != channels.end(); ++i)
  {
    const Imf::Channel& channel = i.channel();
    bytes += (channel.type == Imf::HALF ? 2.0 : 4.0) *
      std::floor(width / std::max(1, channel.xSampling)) *
      std::floor(height / std::max(1, channel.ySampling));
  }
  const bool deep = header.hasType() && Imf::isDeepData(header.type());
  if (8.0 * CountChunks(header, tiled, width, height) > fileSize ||
    (!deep && bytes > fileSize * FindLargestRatio(header.compression())))
  {
    RefuseHeader("its header claims " + std::to_string(static_cast<long long>(width)) + " x " +
      std::to_string(static_cast<long long>(height)) +
      " pixels, or a number of chunks, that no file of " +
      std::to_string(static_cast<long long>(fileSize)) + " bytes can hold");
  }
}

// Returns false at the end of the headers.
bool ReadHeader(EXRInput& input, int version)
{
  Imf::Header header;
  std::string name = ReadName(input);
  const bool any = !name.empty();
  for (; !name.empty(); name = ReadName(input))
  {
    ReadAttribute(input, name, version, header);
  }
  if (any)
  {
    const bool byType = header.hasType() && (Imf::isMultiPart(version) || Imf::isNonImage(version));
    CheckSize(header, byType ? Imf::isTiled(header.type()) : Imf::isTiled(version),
      static_cast<double>(input.GetSize()));
  }
  return any;
}

}

void CheckEXRHeaders(EXRInput& input)
{
  if (input.GetSize() < 8 || ReadNumber(input) != Imf::MAGIC)
  {
    throw FileError(vtkErrorCode::UnrecognizedFileTypeError, "it is no EXR file");
  }
  const int version = static_cast<int>(ReadNumber(input));
  if (Imf::getVersion(version) != Imf::EXR_VERSION)
  {
    throw FileError(vtkErrorCode::FileFormatError,
      "its version of the EXR format is not 2, the only supported version; convert the file");
  }
  while (ReadHeader(input, version) && Imf::isMultiPart(version))
  {
  }
  input.seekg(0);
}

double CountBytesOfChunk(const Imf::Header& header)
{
  double bytes = 0.0;
  const Imf::ChannelList& channels = header.channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
  {
    bytes += channel.channel().type == Imf::HALF ? 2.0 : 4.0;
  }
  if (header.hasTileDescription())
  {
    const Imf::TileDescription& tile = header.tileDescription();
    return bytes * tile.xSize * tile.ySize;
  }
  const Imath::Box2i& window = header.dataWindow();
  return bytes * (double(window.max.x) - window.min.x + 1.0) *
    CountLinesOfChunk(header.compression());
}

}
