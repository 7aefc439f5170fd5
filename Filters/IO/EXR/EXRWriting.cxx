#include "EXR/EXRWriting.h"

#include "Common/FileError.h"
#include "EXR/EXRAttributes.h"
#include "EXR/EXRHeaderScan.h"
#include "EXR/EXRStreams.h"
#include "FileReplacement.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfFramesPerSecond.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace activesurface
{

namespace
{

// Index: vtkActiveEXRWriter::CompressionType.
constexpr Imf::Compression Compressions[] = { Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION,
  Imf::ZIPS_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION };

Imath::M44f ToImf(const vtkMatrix4x4& matrix)
{
  Imath::M44f transposed;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      transposed[column][row] = static_cast<float>(matrix.GetElement(row, column));
    }
  }
  return transposed;
}

struct Windows
{
  Imath::Box2i Data, Display;
};

// Rows run downward from the top of the display window.
Windows MakeWindows(const EXRHeaderSettings& settings)
{
  const auto& extent = settings.Extent;
  const int width = settings.DisplaySize[0], height = settings.DisplaySize[1];
  if (width == 0 && height == 0)
  {
    const Imath::Box2i window(
      Imath::V2i(0, 0), Imath::V2i(extent[1] - extent[0], extent[3] - extent[2]));
    return { window, window };
  }
  return { Imath::Box2i(Imath::V2i(extent[0], height - 1 - extent[3]),
             Imath::V2i(extent[1], height - 1 - extent[2])),
    Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(width - 1, height - 1)) };
}

void AddAttributes(const EXRHeaderSettings& settings, Imf::Header& header)
{
  for (const auto& [name, text] : settings.Texts)
  {
    header.insert(name, Imf::StringAttribute(text));
  }
  for (const auto& [name, number] : settings.Numbers)
  {
    header.insert(name, Imf::DoubleAttribute(number));
  }
  if (!settings.TimeCode.empty())
  {
    AddTimeCode(header, settings.TimeCode);
  }
  if (settings.FramesPerSecond > 0.0)
  {
    // An exact ratio for rates such as 24000/1001.
    Imf::addFramesPerSecond(header, Imf::guessExactFps(settings.FramesPerSecond));
  }
  if (settings.WorldToCamera)
  {
    Imf::addWorldToCamera(header, ToImf(*settings.WorldToCamera));
  }
  if (settings.WorldToNDC)
  {
    Imf::addWorldToNDC(header, ToImf(*settings.WorldToNDC));
  }
}

Imf::Header MakeHeader(const EXRHeaderSettings& settings, const std::vector<EXRSource>& sources)
{
  const Windows windows = MakeWindows(settings);
  Imf::Header header(windows.Display, windows.Data, static_cast<float>(settings.PixelAspectRatio),
    Imath::V2f(0.0f, 0.0f), 1.0f, Imf::INCREASING_Y, Compressions[settings.Compression]);
  header.zipCompressionLevel() = settings.Level;
  AddAttributes(settings, header);
  for (const EXRSource& source : sources)
  {
    header.channels().insert(
      source.Channel, Imf::Channel(static_cast<Imf::PixelType>(source.Type)));
  }
  return header;
}

void CheckLoss(const EXRHeaderSettings& settings, const std::vector<EXRSource>& sources)
{
  const auto isData = [](const EXRSource& source)
  { return !IsColorChannel(source.Channel) || source.Type == EXRPixel::UINT; };
  const auto data = std::find_if(sources.begin(), sources.end(), isData);
  if (Compressions[settings.Compression] == Imf::DWAA_COMPRESSION && data != sources.end())
  {
    throw FileError(vtkErrorCode::UserError,
      "Compression DWAA is lossy and only for colors of type HALF or FLOAT, but channel " +
        data->Channel + " is no such color; choose ZIP or PIZ.");
  }
}

// Rows of an array run upward, rows of the file downward.
Imf::Slice MakeSlice(const EXRSamples& samples, const Imath::Box2i& window)
{
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(samples.Stride);
  const std::ptrdiff_t row = stride * (window.max.x - window.min.x + 1);
  const std::intptr_t base =
    reinterpret_cast<std::intptr_t>(samples.First) + window.max.y * row - window.min.x * stride;
  return Imf::Slice(static_cast<Imf::PixelType>(samples.Type), reinterpret_cast<char*>(base),
    samples.Stride, static_cast<std::size_t>(-row));
}

// Sets the number of OpenEXR's worker threads while one file is written, unless the program has set
// a number. The default of OpenEXR is no worker thread.
class PackingThreads
{
public:
  PackingThreads()
    : AreOwn(Imf::globalThreadCount() == 0)
  {
    const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
    if (this->AreOwn && threads > 1)
    {
      Imf::setGlobalThreadCount(threads);
    }
  }
  ~PackingThreads()
  {
    if (this->AreOwn)
    {
      Imf::setGlobalThreadCount(0);
    }
  }
  PackingThreads(const PackingThreads&) = delete;
  void operator=(const PackingThreads&) = delete;

private:
  const bool AreOwn;
};

void WritePixels(
  EXROutput& output, const EXRHeaderSettings& settings, const std::vector<EXRSource>& sources)
{
  const Imf::Header header = MakeHeader(settings, sources);
  const Imath::Box2i& window = header.dataWindow();
  std::vector<EXRSamples> channels; // has to outlive the frame buffer, which refers to it
  channels.reserve(sources.size());
  Imf::FrameBuffer frame;
  for (const EXRSource& source : sources)
  {
    channels.push_back(MakeSamples(source));
    frame.insert(source.Channel, MakeSlice(channels.back(), window));
  }
  if (CountBytesOfChunk(header) > std::numeric_limits<std::int32_t>::max())
  {
    throw FileError(vtkErrorCode::UserError,
      "the image is too wide: a block of rows (16 with ZIP, 32 with PIZ and DWAA) has more than "
      "2 GiB. Use ZIPS, or write parts of the image or fewer channels.");
  }
  const PackingThreads threads;
  Imf::OutputFile file(output, header);
  file.setFrameBuffer(frame);
  file.writePixels(window.max.y - window.min.y + 1);
}

// Calls an action of a FileReplacement and converts its std::runtime_error to FileError.
template <class Action>
auto WithName(const Action& action)
{
  try
  {
    return action();
  }
  catch (const std::runtime_error& error)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError, error.what());
  }
}

}

void WriteEXR(
  const std::string& name, const EXRHeaderSettings& settings, const std::vector<EXRSource>& sources)
{
  CheckLoss(settings, sources);
  FileReplacement replacement = WithName([&name] { return FileReplacement(name); });
  EXROutput output(replacement.GetTemporaryName());
  try
  {
    WritePixels(output, settings, sources);
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception&)
  {
    if (output.GetErrorNumber() == 0)
    {
      throw;
    }
  }
  output.Close();
  WithName([&replacement] { replacement.Finish(); });
}

namespace
{

constexpr std::size_t LongestChannelName = 255;

[[noreturn]] void Refuse(const std::string& sentence)
{
  throw FileError(vtkErrorCode::UserError, sentence);
}

bool IsInteger(const vtkDataArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

// Returns true for colors: arrays of 3 or 4 components that are named RGB or RGBA, or consist of
// unsigned integers of 8 or 16 bits.
bool IsColor(vtkDataArray* array, const std::string& name)
{
  const int components = array->GetNumberOfComponents(), type = array->GetDataType();
  const bool picture = type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT;
  return ((name == "RGB" || name == "RGBA") && components >= 3 && components <= 4) ||
    (picture && components >= 3 && components <= 4);
}

EXRPixel ChooseType(vtkDataArray* array, const std::string& name, const EXRChoices& choices)
{
  const auto chosen = choices.Types.find(name);
  if (chosen != choices.Types.end())
  {
    return chosen->second;
  }
  if (!IsInteger(array))
  {
    return EXRPixel::FLOAT;
  }
  return IsColor(array, name) ? EXRPixel::HALF : EXRPixel::UINT;
}

std::vector<std::string> ComponentChannels(
  vtkDataArray* array, const std::string& name, bool picture)
{
  const int count = array->GetNumberOfComponents();
  const bool color = picture || IsColor(array, name);
  auto channels = NameChannels(picture ? "RGBA" : name, count, color);
  for (int i = 0; i < count && !picture && name != "RGB" && name != "RGBA"; ++i)
  {
    const char* component = array->GetComponentName(i);
    if (component && *component)
    {
      channels[static_cast<std::size_t>(i)] = name + "." + component;
    }
  }
  return channels;
}

EXRSource MakeSource(
  vtkDataArray* array, int component, const std::string& channel, const EXRChoices& choices)
{
  const std::string name = array->GetName();
  EXRSource source;
  source.Channel = channel;
  source.Array = array;
  source.Component = component;
  source.Type = ChooseType(array, name, choices);
  const bool color = IsColor(array, name);
  source.Normalized = color && IsInteger(array) && source.Type != EXRPixel::UINT;
  source.FromSRGB = choices.FromSRGB && color && component < 3 && source.Type != EXRPixel::UINT;
  if (channel.empty() || channel.size() > LongestChannelName)
  {
    Refuse("The channel name \"" + channel +
      "\" has to have 1 to 255 bytes; rename the array, or correct the name: ClearChannels, then "
      "AddChannel for each component.");
  }
  return source;
}

std::vector<EXRSource> PlanRequested(vtkPointData* data, const EXRChoices& choices)
{
  std::vector<EXRSource> sources;
  for (const EXRChannelRequest& request : choices.Channels)
  {
    vtkDataArray* array = data->GetArray(request.Array.c_str());
    if (!array || request.Component < 0 || request.Component >= array->GetNumberOfComponents())
    {
      Refuse("Channel " + request.Channel + " asks for component " +
        std::to_string(request.Component) + " of point array \"" + request.Array +
        "\", but the input has no numeric point array of this name, or the array has no such "
        "component; call ClearChannels, then AddChannel with arrays and components of the input.");
    }
    sources.push_back(MakeSource(array, request.Component, request.Channel, choices));
  }
  return sources;
}

void PlanArray(
  vtkDataArray* array, bool scalars, const EXRChoices& choices, std::vector<EXRSource>& sources)
{
  // Color scalars need not be named RGB: other readers and windows name them PNGImage or
  // ImageScalars.
  const bool picture = scalars && array->GetName() && IsColor(array, array->GetName());
  if (!array->GetName() || !*array->GetName())
  {
    Refuse(
      "A point array of the input has no name, which its channels need; set the array's name.");
  }
  const auto channels = ComponentChannels(array, array->GetName(), picture);
  for (std::size_t i = 0; i < channels.size(); ++i)
  {
    sources.push_back(MakeSource(array, static_cast<int>(i), channels[i], choices));
  }
}

}

std::vector<EXRSource> PlanChannels(vtkImageData* image, const EXRChoices& choices)
{
  vtkPointData* data = image->GetPointData();
  std::vector<EXRSource> sources = PlanRequested(data, choices);
  const auto isRequested = [&choices](const char* name)
  {
    return name &&
      std::any_of(choices.Channels.begin(), choices.Channels.end(),
        [name](const EXRChannelRequest& request) { return request.Array == name; });
  };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i); // null for texts
    if (array && !isRequested(array->GetName()))
    {
      PlanArray(array, array == data->GetScalars(), choices, sources);
    }
  }
  if (sources.empty())
  {
    Refuse("The input has no numeric point array; add one to the image.");
  }
  std::sort(sources.begin(), sources.end(),
    [](const EXRSource& a, const EXRSource& b) { return a.Channel < b.Channel; });
  const auto twice = std::adjacent_find(sources.begin(), sources.end(),
    [](const EXRSource& a, const EXRSource& b) { return a.Channel == b.Channel; });
  if (twice != sources.end())
  {
    Refuse("Two components would be written as channel " + twice->Channel +
      "; rename an array, or name its channels: ClearChannels, then AddChannel for each "
      "component.");
  }
  return sources;
}

}
