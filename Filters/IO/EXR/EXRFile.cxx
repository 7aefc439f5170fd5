#include "EXR/EXRFile.h"

#include "Common/FileError.h"
#include "EXR/EXRHeaderScan.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

#include <cstring>

namespace activesurface
{

namespace
{

// Calls an action that reads and converts exceptions of OpenEXR to FileError.
template <class Action>
void Guard(const EXRInput& input, const Action& action)
{
  try
  {
    action();
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    if (input.HasEndedEarly())
    {
      throw FileError(vtkErrorCode::PrematureEndOfFileError, "it ends too early");
    }
    throw FileError(
      vtkErrorCode::FileFormatError, std::string("it is damaged (OpenEXR: ") + error.what() + ")");
  }
}

// Converts a window to columns and rows from the lower left of the display window.
EXRExtent Flip(const Imath::Box2i& window, const Imath::Box2i& display)
{
  return { window.min.x - display.min.x, window.max.x - display.min.x, display.max.y - window.max.y,
    display.max.y - window.min.y };
}

EXRPart Describe(const Imf::Header& header)
{
  EXRPart part;
  part.Name = header.hasName() ? header.name() : "";
  part.Type = header.type(); // OpenEXR adds a missing one
  part.Data = Flip(header.dataWindow(), header.displayWindow());
  part.Display = Flip(header.displayWindow(), header.displayWindow());
  const Imf::ChannelList& channels = header.channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
  {
    const Imf::Channel& found = channel.channel();
    part.Channels.push_back(
      { channel.name(), static_cast<EXRPixel>(found.type), found.xSampling, found.ySampling });
  }
  if (const auto* time = header.findTypedAttribute<Imf::DoubleAttribute>("time"))
  {
    part.Time = time->value();
  }
  part.ChunkBytes = CountBytesOfChunk(header);
  return part;
}

// Rounds down, for negative coordinates as well.
int FloorDivide(int value, int divisor)
{
  const int quotient = value / divisor;
  return quotient * divisor > value ? quotient - 1 : quotient;
}

// Channel with fewer samples than the image has pixels. The samples are read into a buffer, and
// each sample is repeated over its pixels.
struct Subsampled
{
  Subsampled(
    const EXRDestination& destination, const Imf::Channel& channel, const Imath::Box2i& window)
    : Destination(destination)
    , Channel(channel)
    , Left(FloorDivide(window.min.x, channel.xSampling))
    , Top(FloorDivide(window.min.y, channel.ySampling))
    , Width(FloorDivide(window.max.x, channel.xSampling) - this->Left + 1)
    , Samples(4 * static_cast<std::size_t>(this->Width) *
        (FloorDivide(window.max.y, channel.ySampling) - this->Top + 1))
  {
  }

  Imf::Slice MakeSlice(Imf::PixelType type)
  {
    const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(this->Width);
    const std::intptr_t base =
      reinterpret_cast<std::intptr_t>(this->Samples.data()) - 4 * this->Left - row * this->Top;
    return Imf::Slice(type, reinterpret_cast<char*>(base), 4, static_cast<std::size_t>(row),
      this->Channel.xSampling, this->Channel.ySampling);
  }

  const char* At(int x, int y) const
  {
    const std::size_t column = FloorDivide(x, this->Channel.xSampling) - this->Left;
    const std::size_t row = FloorDivide(y, this->Channel.ySampling) - this->Top;
    return this->Samples.data() + 4 * (row * this->Width + column);
  }

  EXRDestination Destination;
  Imf::Channel Channel;
  int Left, Top, Width;
  std::vector<char> Samples;
};

// Address of a pixel in an image that covers an extent; the pixel may lie outside the extent.
struct PixelPlace
{
  EXRExtent Extent;
  Imath::Box2i Display;

  std::ptrdiff_t Row(std::size_t stride) const
  {
    const std::ptrdiff_t first = this->Extent[0], last = this->Extent[1];
    return static_cast<std::ptrdiff_t>(stride) * (last - first + 1);
  }

  char* At(const EXRDestination& to, int x, int y) const
  {
    const std::ptrdiff_t column =
      static_cast<std::ptrdiff_t>(x) - this->Display.min.x - this->Extent[0];
    const std::ptrdiff_t row =
      static_cast<std::ptrdiff_t>(this->Display.max.y) - y - this->Extent[2];
    return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(to.Pixels) +
      column * static_cast<std::ptrdiff_t>(to.Stride) + row * this->Row(to.Stride));
  }
};

void Repeat(const Subsampled& channel, const PixelPlace& place, const Imath::Box2i& window)
{
  for (int y = window.min.y; y <= window.max.y; ++y)
  {
    for (int x = window.min.x; x <= window.max.x; ++x)
    {
      std::memcpy(place.At(channel.Destination, x, y), channel.At(x, y), 4);
    }
  }
}

void ReadPixels(
  Imf::InputPart& part, const EXRExtent& extent, const std::vector<EXRDestination>& destinations)
{
  const Imf::Header& header = part.header();
  const Imath::Box2i window = header.dataWindow();
  const PixelPlace place{ extent, header.displayWindow() };
  Imf::FrameBuffer frame;
  std::vector<std::unique_ptr<Subsampled>> subsampled;
  for (const EXRDestination& to : destinations)
  {
    const Imf::Channel& channel = header.channels()[to.Channel];
    const Imf::PixelType type = channel.type == Imf::UINT ? Imf::UINT : Imf::FLOAT;
    if (channel.xSampling != 1 || channel.ySampling != 1)
    {
      subsampled.push_back(std::make_unique<Subsampled>(to, channel, window));
      frame.insert(to.Channel, subsampled.back()->MakeSlice(type));
      continue;
    }
    // Rows run downward in the file and upward in the image.
    frame.insert(to.Channel,
      Imf::Slice(
        type, place.At(to, 0, 0), to.Stride, static_cast<std::size_t>(-place.Row(to.Stride))));
  }
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  for (const auto& channel : subsampled)
  {
    Repeat(*channel, place, window);
  }
}

}

EXRFile::EXRFile(const std::string& name, const EXRMemory& memory)
  : Input(name, memory)
{
  Guard(this->Input,
    [this]
    {
      CheckEXRHeaders(this->Input);
      this->File = std::make_unique<Imf::MultiPartInputFile>(this->Input, 0);
      for (int part = 0; part < this->File->parts(); ++part)
      {
        this->Parts.push_back(Describe(this->File->header(part)));
      }
    });
}

EXRFile::~EXRFile() = default;

const Imf::Header& EXRFile::GetHeader(std::size_t part) const
{
  return this->File->header(static_cast<int>(part));
}

void EXRFile::Read(
  std::size_t part, const EXRExtent& extent, const std::vector<EXRDestination>& channels)
{
  Guard(this->Input,
    [&]
    {
      Imf::InputPart input(*this->File, static_cast<int>(part));
      ReadPixels(input, extent, channels);
    });
}

}
