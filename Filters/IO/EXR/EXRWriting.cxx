#include "EXR/EXRWriting.h"

#include "Common/FileError.h"
#include "EXR/EXRAttributes.h"
#include "EXR/EXRHeaderScan.h"
#include "EXR/EXRStreams.h"
#include "FileReplacement.h"

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

// By vtkActiveEXRWriter::CompressionType.
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
      "Compression DWAA loses what the eye does not see, and channel " + data->Channel +
        " holds data, not colors; choose ZIP or PIZ.");
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

// Worker threads of OpenEXR, for one file. OpenEXR has none unless the program sets their number,
// which is then kept.
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
  std::vector<EXRSamples> channels; // outlives the frame buffer, which refers to it
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
      "the image is too wide for the format: the rows that are packed at a time (16 by ZIP, 32 by "
      "PIZ and DWAA) need more than 2 GiB.");
  }
  const PackingThreads threads;
  Imf::OutputFile file(output, header);
  file.setFrameBuffer(frame);
  file.writePixels(window.max.y - window.min.y + 1);
}

// Calls an action on the file's name and converts exceptions to FileError.
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

}
