#include "EXR/EXRHeaderScan.h"

#include "FileError.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <vector>

namespace activesurface
{

namespace
{

constexpr std::uint32_t Magic = 20000630;
constexpr std::uint32_t TiledFlag = 0x200, DeepFlag = 0x800, MultiPartFlag = 0x1000;
constexpr std::size_t LongestName = 255;
constexpr std::int64_t FarthestPixel = 1 << 29; // sums and differences of three fit into an int
constexpr std::int64_t LargestTile = 1 << 22;   // pixels; or the size of the image

// Lines in a chunk, and an upper bound of the bytes that one packed byte unpacks to, by the
// compression's number in the header. Deflate reaches 1032, RLE 64, PIZ's run codes 453, for which
// 1032 is a bound, too. DWA deflates the means of blocks of 64 pixels. B44 packs 32 bytes into 3.
struct Compression
{
  int Lines;
  double Ratio;
};
constexpr Compression Compressions[] = { { 1, 1 }, { 1, 64 }, { 1, 1032 }, { 16, 1032 },
  { 32, 1032 }, { 16, 1032 }, { 32, 11 }, { 32, 11 }, { 32, 66048 }, { 256, 66048 } };
// Compressions newer than this code.
constexpr Compression OtherCompression = { 256, 66048 };

Compression FindCompression(unsigned number)
{
  return number < std::size(Compressions) ? Compressions[number] : OtherCompression;
}

// OpenEXR reads this number of bytes for an attribute of these types, whatever size the file
// states. It interprets the next bytes as the next attribute.
struct FixedSize
{
  const char* Type;
  std::uint64_t Bytes;
};
constexpr FixedSize FixedSizes[] = { { "box2f", 16 }, { "box2i", 16 }, { "chromaticities", 32 },
  { "compression", 1 }, { "deepImageState", 1 }, { "double", 8 }, { "envmap", 1 }, { "float", 4 },
  { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 }, { "m33d", 72 }, { "m33f", 36 },
  { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 }, { "tiledesc", 9 }, { "timecode", 8 },
  { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 }, { "v3f", 12 }, { "v3i", 12 } };

bool HasOwnSize(const std::string& type, std::uint64_t size)
{
  const auto found = std::find_if(std::begin(FixedSizes), std::end(FixedSizes),
    [&type](const FixedSize& fixed) { return type == fixed.Type; });
  return found == std::end(FixedSizes) || found->Bytes == size;
}

[[noreturn]] void Refuse(const std::string& sentence)
{
  throw FileError(vtkErrorCode::FileFormatError, sentence);
}

// Values of a header that determine the memory that OpenEXR allocates.
struct PartClaims
{
  std::int64_t Width = 0, Height = 0;
  std::int64_t TileWidth = 0, TileHeight = 0;
  std::int64_t PixelBytes = 0;
  Compression Packed = OtherCompression;
  bool Deep = false;
};

class HeaderScan
{
public:
  explicit HeaderScan(EXRInput& input)
    : Input(input)
  {
  }

  void Run()
  {
    if (this->Input.GetSize() < 8 || this->Number() != Magic)
    {
      throw FileError(vtkErrorCode::UnrecognizedFileTypeError, "it is no EXR file");
    }
    const std::uint32_t version = this->Number();
    if ((version & 0xff) != 2)
    {
      Refuse("its version of the format is not supported");
    }
    const bool multiPart = (version & MultiPartFlag) != 0;
    std::vector<PartClaims> parts;
    do
    {
      parts.push_back(this->Part((version & DeepFlag) != 0, (version & TiledFlag) != 0));
    } while (multiPart && !this->AtEndOfHeaders());
    this->Check(parts);
    this->Input.seekg(0);
  }

private:
  char Byte()
  {
    char byte = 0;
    this->Input.read(&byte, 1);
    return byte;
  }

  std::uint32_t Number()
  {
    unsigned char bytes[4];
    this->Input.read(reinterpret_cast<char*>(bytes), 4);
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
  }

  std::int64_t SignedNumber() { return static_cast<std::int32_t>(this->Number()); }

  std::string Name()
  {
    std::string name;
    while (const char byte = this->Byte())
    {
      name += byte;
      if (name.size() > LongestName)
      {
        Refuse("a name in its header has no end");
      }
    }
    return name;
  }

  bool AtEndOfHeaders()
  {
    const std::uint64_t position = this->Input.tellg();
    const bool atEnd = this->Byte() == 0;
    if (!atEnd)
    {
      this->Input.seekg(position);
    }
    return atEnd;
  }

  PartClaims Part(bool deep, bool tiled)
  {
    PartClaims part;
    part.Deep = deep;
    bool hasWindow = false, hasTiles = false;
    for (std::string name = this->Name(); !name.empty(); name = this->Name())
    {
      const std::string type = this->Name();
      const std::uint64_t size = this->Number();
      const std::uint64_t begin = this->Input.tellg();
      if (size > this->Input.GetSize() - begin)
      {
        Refuse("attribute " + name + " of its header is larger than the file");
      }
      hasWindow = hasWindow || name == "dataWindow";
      hasTiles = hasTiles || name == "tiles";
      if (!HasOwnSize(type, size))
      {
        std::string told = "attribute ";
        told.append(name).append(" of its header is not as large as a ").append(type);
        Refuse(told);
      }
      this->Attribute(name, type, size, part);
      this->Input.seekg(begin + size);
    }
    if (!hasWindow || (tiled && !hasTiles))
    {
      Refuse("its header lacks what every one has");
    }
    return part;
  }

  void Attribute(
    const std::string& name, const std::string& type, std::uint64_t size, PartClaims& part)
  {
    if (name == "dataWindow" || name == "displayWindow")
    {
      this->Window(name, type, size, part);
    }
    else if (type == "chlist")
    {
      const std::uint64_t end = this->Input.tellg() + size;
      PartClaims other;
      if (!this->Channels(end, name == "channels" ? part : other))
      {
        Refuse("the list of channels in its header is not as long as it says");
      }
    }
    else if (name == "compression" && size == 1)
    {
      part.Packed = FindCompression(static_cast<unsigned char>(this->Byte()));
    }
    else if (name == "tiles" && size == 9)
    {
      part.TileWidth = this->Number();
      part.TileHeight = this->Number();
    }
    else if (type == "preview" && size >= 8)
    {
      const std::uint64_t width = this->Number(), height = this->Number();
      if (height != 0 && (width > size / 4 / height || 8 + 4 * width * height != size))
      {
        Refuse("its preview is not as large as it says");
      }
    }
  }

  void Window(
    const std::string& name, const std::string& type, std::uint64_t size, PartClaims& part)
  {
    if (type != "box2i" || size != 16)
    {
      Refuse("attribute " + name + " of its header is no window");
    }
    const std::int64_t left = this->SignedNumber(), top = this->SignedNumber();
    const std::int64_t right = this->SignedNumber(), bottom = this->SignedNumber();
    const auto far = [](std::int64_t place)
    { return place < -FarthestPixel || place > FarthestPixel; };
    if (far(left) || far(top) || far(right) || far(bottom) || left > right || top > bottom)
    {
      Refuse(name + " of its header, (" + std::to_string(left) + ", " + std::to_string(top) +
        ") to (" + std::to_string(right) + ", " + std::to_string(bottom) + "), is absurd");
    }
    if (name == "dataWindow")
    {
      part.Width = right - left + 1;
      part.Height = bottom - top + 1;
    }
  }

  // Returns true if the empty name that ends the list is at the end of the attribute.
  bool Channels(std::uint64_t end, PartClaims& part)
  {
    while (this->Input.tellg() < end)
    {
      if (this->Name().empty())
      {
        return this->Input.tellg() == end;
      }
      const std::uint32_t type = this->Number();
      this->Number(); // linearity flag and reserved bytes
      const std::int64_t x = this->SignedNumber(), y = this->SignedNumber();
      if (type > 2 || x < 1 || y < 1)
      {
        Refuse("a channel of its header has no type or no sampling");
      }
      // Subsampled channels count as 0, which keeps PixelBytes a lower bound.
      part.PixelBytes += x * y > 1 ? 0 : (type == 1 ? 2 : 4);
    }
    return false;
  }

  void Check(const std::vector<PartClaims>& parts) const
  {
    const std::uint64_t size = this->Input.GetSize();
    for (const PartClaims& part : parts)
    {
      const std::int64_t area = part.Width * part.Height; // below 2^63: each is below 2^31 + 2
      const bool tiled = part.TileWidth != 0 || part.TileHeight != 0;
      if (tiled && !IsTileSane(part, area))
      {
        Refuse("the tiles of its header are absurdly large or small");
      }
      const std::int64_t chunks = tiled
        ? Pieces(part.Width, part.TileWidth) * Pieces(part.Height, part.TileHeight)
        : Pieces(part.Height, part.Packed.Lines);
      const double bytes =
        part.Deep ? 0.0 : static_cast<double>(area) * static_cast<double>(part.PixelBytes);
      if (static_cast<std::uint64_t>(chunks) > size / 8 ||
        bytes > static_cast<double>(size) * part.Packed.Ratio)
      {
        Refuse("its header claims an image of " + std::to_string(part.Width) + " x " +
          std::to_string(part.Height) + " pixels, which no file of " + std::to_string(size) +
          " bytes can hold");
      }
    }
  }

  static bool IsTileSane(const PartClaims& part, std::int64_t area)
  {
    return part.TileWidth >= 1 && part.TileHeight >= 1 && part.TileWidth <= FarthestPixel &&
      part.TileHeight <= FarthestPixel &&
      part.TileWidth * part.TileHeight <= std::max(LargestTile, area);
  }

  static std::int64_t Pieces(std::int64_t whole, std::int64_t piece)
  {
    return (whole + piece - 1) / piece;
  }

  EXRInput& Input;
};

}

void CheckEXRHeaders(EXRInput& input)
{
  HeaderScan(input).Run();
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
    FindCompression(static_cast<unsigned>(header.compression())).Lines;
}

bool IsEXR(std::istream& stream)
{
  const char magic[4] = { 0x76, 0x2f, 0x31, 0x01 };
  char bytes[4] = {};
  stream.read(bytes, 4);
  return stream && std::memcmp(magic, bytes, 4) == 0;
}

}
