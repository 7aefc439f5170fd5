#include "EXR/EXRImage.h"

#include "Common/FileError.h"
#include "EXR/EXRAttributes.h"
#include "EXR/EXRHeaderScan.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedIntArray.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <algorithm>
#include <cstring>
#include <iterator>
#include <new>

namespace activesurface
{

namespace
{

double CountPixels(const EXRExtent& extent)
{
  return (static_cast<double>(extent[1]) - extent[0] + 1) *
    (static_cast<double>(extent[3]) - extent[2] + 1);
}

// Returns the bytes needed to read: the pixels, the samples of subsampled channels, and a chunk in
// packed, unpacked and intermediate form.
double CountBytes(const EXRPart& part, const std::vector<EXRLayer>& layers, const EXRExtent& extent)
{
  constexpr double bytesOfPixel = 4.0;
  double channels = 0.0;
  for (const EXRLayer& layer : layers)
  {
    channels += static_cast<double>(layer.Channels.size());
  }
  for (const EXRChannel& channel : part.Channels)
  {
    const double sampling = double(channel.XSampling) * channel.YSampling;
    channels += sampling > 1.0 ? 1.0 / sampling : 0.0;
  }
  return bytesOfPixel * channels * CountPixels(extent) + 3.0 * part.ChunkBytes;
}

vtkSmartPointer<vtkDataArray> MakeArray(const EXRLayer& layer, vtkIdType pixels)
{
  auto array = layer.Integer
    ? vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkUnsignedIntArray>::New())
    : vtkSmartPointer<vtkDataArray>(vtkSmartPointer<vtkFloatArray>::New());
  array->SetName(layer.Array.c_str());
  array->SetNumberOfComponents(static_cast<int>(layer.Channels.size()));
  for (std::size_t i = 0; i < layer.Components.size(); ++i)
  {
    array->SetComponentName(static_cast<vtkIdType>(i), layer.Components[i].c_str());
  }
  array->SetNumberOfTuples(pixels);
  return array;
}

// Adds an array. If the array's name is in use already, as for a channel N and a layer N.X, N.Y,
// N.Z, appends a number to the name.
void AddUnderOwnName(vtkDataArray* array, vtkPointData* data)
{
  const std::string name = array->GetName();
  for (int i = 2; data->HasArray(array->GetName()); ++i)
  {
    array->SetName((name + "_" + std::to_string(i)).c_str());
  }
  data->AddArray(array);
}

std::vector<EXRDestination> AddArrays(
  const std::vector<EXRLayer>& layers, vtkImageData* image, bool clear)
{
  std::vector<EXRDestination> channels;
  for (const EXRLayer& layer : layers)
  {
    const auto array = MakeArray(layer, image->GetNumberOfPoints());
    const std::size_t stride = 4 * layer.Channels.size();
    char* pixels = static_cast<char*>(array->GetVoidPointer(0));
    if (clear)
    {
      std::memset(pixels, 0, stride * static_cast<std::size_t>(array->GetNumberOfTuples()));
    }
    for (std::size_t i = 0; i < layer.Channels.size(); ++i)
    {
      channels.push_back({ layer.Channels[i], pixels + 4 * i, stride });
    }
    AddUnderOwnName(array, image->GetPointData());
  }
  return channels;
}

}

EXRExtent UniteExtents(const EXRExtent& a, const EXRExtent& b)
{
  return { std::min(a[0], b[0]), std::max(a[1], b[1]), std::min(a[2], b[2]), std::max(a[3], b[3]) };
}

const EXRPart& FindEXRPart(const EXRFile& file, std::size_t part)
{
  const auto count = file.GetParts().size();
  if (part >= count)
  {
    throw FileError(vtkErrorCode::UserError,
      "it has no Part " + std::to_string(part) + "; set Part to 0" +
        (count > 1 ? " or a number up to " + std::to_string(count - 1) : ", its only part"));
  }
  const EXRPart& found = file.GetParts()[part];
  if (found.Type.compare(0, 4, "deep") == 0)
  {
    throw FileError(vtkErrorCode::FileFormatError,
      "part " + std::to_string(part) +
        " holds deep data, several samples to a pixel, which is not supported; flatten it first");
  }
  return found;
}

std::vector<EXRLayer> FindEXRLayers(const EXRPart& part, const EXRSelection& selection)
{
  std::vector<EXRChannel> channels;
  std::copy_if(part.Channels.begin(), part.Channels.end(), std::back_inserter(channels),
    [&selection](const EXRChannel& channel) { return selection.Has(channel.Name); });
  if (channels.empty())
  {
    throw FileError(vtkErrorCode::UserError,
      "the selected part has none of the enabled channels; enable channels of this part by "
      "EnableChannel, or set Part to a part that has enabled channels");
  }
  return GroupChannels(channels);
}

void ReadEXRImage(EXRFile& file, std::size_t part, const EXRSelection& selection,
  const EXRExtent& extent, double limit, vtkImageData* image)
{
  const EXRPart& description = FindEXRPart(file, part);
  const std::vector<EXRLayer> layers = FindEXRLayers(description, selection);
  const EXRExtent decoded = UniteExtents(extent, description.Data);
  const double bytes = CountBytes(description, layers, decoded);
  if (bytes > limit)
  {
    throw FileError(vtkErrorCode::UserError,
      "reading it needs " + std::to_string(static_cast<long long>(bytes / (1 << 20)) + 1) +
        " MiB, more than MaximumMemory; raise MaximumMemory, or enable fewer channels");
  }
  image->SetExtent(decoded[0], decoded[1], decoded[2], decoded[3], 0, 0);
  file.Read(part, decoded, AddArrays(layers, image, decoded != description.Data));
  image->GetPointData()->SetActiveScalars(layers.front().Array.c_str());
  if (decoded != extent)
  {
    int cropped[6] = { extent[0], extent[1], extent[2], extent[3], 0, 0 };
    image->Crop(cropped);
  }
  CopyEXRAttributes(file.GetHeader(part), image->GetFieldData());
}

namespace
{

// Calls an action that reads. Converts exceptions of OpenEXR to FileError.
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
  catch (const std::bad_alloc&)
  {
    throw FileError(vtkErrorCode::UnknownError,
      "there is not enough memory for its pixels; free memory, or crop or shrink the image");
  }
  catch (const std::exception& error)
  {
    if (input.HasEndedEarly())
    {
      throw FileError(
        vtkErrorCode::PrematureEndOfFileError, "it ends too early; copy or write it again");
    }
    throw FileError(vtkErrorCode::FileFormatError,
      std::string("it is damaged, or not supported by this OpenEXR (") + error.what() +
        "); copy or write it again");
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
  part.Type = header.type(); // OpenEXR adds a missing type
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
