#include "EXR/EXRImage.h"

#include "Common/FileError.h"
#include "EXR/EXRAttributes.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace activesurface
{

namespace
{

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
  std::vector<EXRChannel> channels;
  std::copy_if(part.Channels.begin(), part.Channels.end(), std::back_inserter(channels),
    [&selection](const EXRChannel& channel) { return selection.Has(channel.Name); });
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

}
