#include "EXR/EXRZip.h"

#include "FileError.h"

#include "vtkSMPTools.h"

#include <ImfChannelList.h>
#include <ImfPartType.h>

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

namespace activesurface
{

namespace
{

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "EXR files are little-endian, and written here as memory has them."
#endif

constexpr std::uint32_t Magic = 20000630, Version = 2, LongNames = 0x400;
constexpr std::size_t LongestShortName = 31;
constexpr vtkIdType ChunksAtATime = 2;

using Bytes = std::vector<char>;

struct Chunk
{
  int Top = 0;
  Bytes Packed;
};

// Input shared by all chunks.
struct Pixels
{
  const std::vector<EXRSamples>& Channels;
  Imath::Box2i Window;
  int Level;

  std::size_t Width() const
  {
    return static_cast<std::size_t>(this->Window.max.x) - this->Window.min.x + 1;
  }
};

template <class Sample>
char* CopyRow(const EXRSamples& channel, std::size_t first, std::size_t width, char* to)
{
  const char* from = channel.First + first * channel.Stride;
  for (std::size_t x = 0; x < width; ++x)
  {
    std::memcpy(to + x * sizeof(Sample), from + x * channel.Stride, sizeof(Sample));
  }
  return to + width * sizeof(Sample);
}

std::size_t SizeOf(const EXRSamples& channel)
{
  return channel.Type == EXRPixel::HALF ? 2 : 4;
}

// Collects rows from the top, in each row one channel after the other.
void Gather(const Pixels& pixels, int top, int bottom, Bytes& raw)
{
  std::size_t pixelBytes = 0;
  for (const EXRSamples& channel : pixels.Channels)
  {
    pixelBytes += SizeOf(channel);
  }
  const std::size_t width = pixels.Width();
  raw.resize(pixelBytes * width * static_cast<std::size_t>(bottom - top + 1));
  char* to = raw.data();
  for (int y = top; y <= bottom; ++y)
  {
    const std::size_t row = static_cast<std::size_t>(pixels.Window.max.y - y);
    for (const EXRSamples& channel : pixels.Channels)
    {
      to = SizeOf(channel) == 2 ? CopyRow<std::uint16_t>(channel, row * width, width, to)
                                : CopyRow<std::uint32_t>(channel, row * width, width, to);
    }
  }
}

// Prepares bytes for deflate as OpenEXR does: even positions first, then odd ones. Each byte is
// replaced by its difference from the previous byte, plus 128.
void Prepare(const Bytes& raw, Bytes& split, Bytes& prepared)
{
  const std::size_t size = raw.size(), half = (size + 1) / 2;
  split.resize(size);
  prepared.resize(size);
  for (std::size_t i = 0; i < size / 2; ++i)
  {
    split[i] = raw[2 * i];
    split[half + i] = raw[2 * i + 1];
  }
  if (size % 2 == 1)
  {
    split[half - 1] = raw[size - 1];
  }
  prepared[0] = split[0];
  for (std::size_t i = 1; i < size; ++i)
  {
    prepared[i] = static_cast<char>(split[i] - split[i - 1] + 128);
  }
}

using Compressor = std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)>;

// Packs a chunk. A chunk that does not become smaller is stored unpacked.
void Pack(libdeflate_compressor* compressor, const Bytes& prepared, Bytes& raw, Bytes& packed)
{
  packed.resize(raw.size());
  const std::size_t size = compressor ? libdeflate_zlib_compress(compressor, prepared.data(),
                                          prepared.size(), packed.data(), packed.size() - 1)
                                      : 0;
  if (size == 0)
  {
    packed.swap(raw);
    return;
  }
  packed.resize(size);
  packed.shrink_to_fit();
}

std::vector<Chunk> MakeChunks(const Pixels& pixels, int lines)
{
  const int top = pixels.Window.min.y, bottom = pixels.Window.max.y;
  std::vector<Chunk> chunks(static_cast<std::size_t>((bottom - top) / lines + 1));
  const auto work = [&](vtkIdType begin, vtkIdType end)
  {
    const Compressor compressor(
      libdeflate_alloc_compressor(pixels.Level), libdeflate_free_compressor);
    Bytes raw, split, prepared;
    for (vtkIdType i = begin; i < end; ++i)
    {
      Chunk& chunk = chunks[static_cast<std::size_t>(i)];
      chunk.Top = top + static_cast<int>(i) * lines;
      Gather(pixels, chunk.Top, std::min(bottom, chunk.Top + lines - 1), raw);
      Prepare(raw, split, prepared);
      Pack(compressor.get(), prepared, raw, chunk.Packed);
    }
  };
  vtkSMPTools::For(0, static_cast<vtkIdType>(chunks.size()), ChunksAtATime, work);
  return chunks;
}

bool HasLongNames(const Imf::Header& header)
{
  const auto isLong = [](const char* name) { return std::strlen(name) > LongestShortName; };
  bool found = false;
  for (auto entry = header.begin(); entry != header.end(); ++entry)
  {
    found = found || isLong(entry.name()) || isLong(entry.attribute().typeName());
  }
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
  {
    found = found || isLong(channel.name());
  }
  return found;
}

template <class Number>
void WriteNumber(EXROutput& output, Number number)
{
  output.write(reinterpret_cast<const char*>(&number), sizeof(number));
}

void WriteFile(EXROutput& output, const Imf::Header& header, const std::vector<Chunk>& chunks)
{
  WriteNumber(output, Magic);
  WriteNumber(output, Version | (HasLongNames(header) ? LongNames : 0));
  header.writeTo(output);
  std::uint64_t place = output.tellp() + 8 * chunks.size();
  for (const Chunk& chunk : chunks)
  {
    WriteNumber(output, place);
    place += 8 + chunk.Packed.size();
  }
  for (const Chunk& chunk : chunks)
  {
    WriteNumber(output, static_cast<std::int32_t>(chunk.Top));
    WriteNumber(output, static_cast<std::int32_t>(chunk.Packed.size()));
    output.write(chunk.Packed.data(), static_cast<int>(chunk.Packed.size()));
  }
}

}

bool IsZipped(const Imf::Header& header)
{
  return header.compression() == Imf::ZIP_COMPRESSION ||
    header.compression() == Imf::ZIPS_COMPRESSION;
}

void WriteZipped(
  EXROutput& output, Imf::Header header, const std::vector<EXRSamples>& channels, int level)
{
  constexpr int linesOfZip = 16;
  const int lines = header.compression() == Imf::ZIP_COMPRESSION ? linesOfZip : 1;
  const Pixels pixels{ channels, header.dataWindow(), level };
  if (16.0 * static_cast<double>(pixels.Width()) * lines * static_cast<double>(channels.size()) >
    std::numeric_limits<std::int32_t>::max())
  {
    throw FileError(vtkErrorCode::UserError,
      "the image is too wide for the format: 16 rows of all channels have to be below 512 MiB");
  }
  header.setType(Imf::SCANLINEIMAGE);
  header.sanityCheck();
  WriteFile(output, header, MakeChunks(pixels, lines));
}

}
