#include "EXR/EXRSeries.h"

#include "FileError.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace activesurface
{

namespace
{

// Stream over bytes in memory, without a copy.
class MemoryBuffer : public std::streambuf
{
public:
  explicit MemoryBuffer(const EXRMemory& memory)
  {
    char* begin = const_cast<char*>(memory.Bytes); // streambuf lacks const; only read
    this->setg(begin, begin, begin + memory.Size);
  }

protected:
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override
  {
    return this->seekoff(off_type(position), std::ios::beg, mode);
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override
  {
    const off_type size = this->egptr() - this->eback();
    const off_type base =
      from == std::ios::beg ? 0 : (from == std::ios::end ? size : this->gptr() - this->eback());
    if (base + offset < 0 || base + offset > size)
    {
      return pos_type(off_type(-1));
    }
    this->setg(this->eback(), this->eback() + base + offset, this->egptr());
    return base + offset;
  }
};

void OpenFile(const std::string& name, std::ifstream& stream)
{
  std::error_code error;
  const auto status = std::filesystem::status(name, error);
  if (!std::filesystem::exists(status))
  {
    throw FileError(vtkErrorCode::FileNotFoundError, "there is no such file");
  }
  if (std::filesystem::is_directory(status))
  {
    throw FileError(vtkErrorCode::CannotOpenFileError, "it is a folder");
  }
  stream.open(name, std::ios::binary);
  if (!stream)
  {
    throw FileError(
      vtkErrorCode::CannotOpenFileError, std::string("it cannot be opened: ") + strerror(errno));
  }
}

double CountPixels(const EXRExtent& extent)
{
  return (static_cast<double>(extent[1]) - extent[0] + 1) *
    (static_cast<double>(extent[3]) - extent[2] + 1);
}

// Bytes needed to read: the pixels, the samples of subsampled channels, and a chunk in packed,
// unpacked and intermediate form.
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

bool Covers(const EXRExtent& whole, const EXRExtent& piece)
{
  return UniteExtents(whole, piece) == whole;
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

// Appends a number to the second of two equal names, as of a channel N and the layer N.X, N.Y, N.Z.
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

void SetExtent(vtkImageData* image, const EXRExtent& extent)
{
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], 0, 0);
}

}

EXRExtent UniteExtents(const EXRExtent& a, const EXRExtent& b)
{
  return { std::min(a[0], b[0]), std::max(a[1], b[1]), std::min(a[2], b[2]), std::max(a[3], b[3]) };
}

void WithEXRFile(
  const std::string& name, const EXRMemory& memory, const std::function<void(EXRFile&)>& read)
{
  try
  {
    if (memory.Bytes)
    {
      MemoryBuffer buffer(memory);
      std::istream stream(&buffer);
      EXRFile file(stream, name);
      read(file);
      return;
    }
    std::ifstream stream;
    OpenFile(name, stream);
    EXRFile file(stream, name);
    read(file);
  }
  catch (const FileError& error)
  {
    throw FileError(error.GetCode(), "Cannot read \"" + name + "\": " + error.what() + ".");
  }
}

const EXRPart& FindEXRPart(const EXRFile& file, std::size_t part)
{
  const auto count = file.GetParts().size();
  if (part >= count)
  {
    throw FileError(vtkErrorCode::UserError,
      "it has no Part " + std::to_string(part) + ", they are 0 to " + std::to_string(count - 1));
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
  std::vector<EXRNamedPixel> channels;
  for (const EXRChannel& channel : part.Channels)
  {
    if (selection.Has(channel.Name))
    {
      channels.push_back({ channel.Name, channel.Type });
    }
  }
  if (channels.empty())
  {
    throw FileError(vtkErrorCode::UserError, "it has none of the channels that are enabled");
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
      "reading it takes " + std::to_string(static_cast<long long>(bytes / (1 << 20)) + 1) +
        " MiB, more than MaximumMemory allows");
  }
  SetExtent(image, decoded);
  file.Read(part, decoded, AddArrays(layers, image, !Covers(description.Data, decoded)));
  image->GetPointData()->SetActiveScalars(layers.front().Array.c_str());
  if (decoded != extent)
  {
    int cropped[6] = { extent[0], extent[1], extent[2], extent[3], 0, 0 };
    image->Crop(cropped);
  }
  file.CopyAttributes(part, image->GetFieldData());
}

}
