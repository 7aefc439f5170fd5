#include "IO/EXRFiles.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

namespace
{

// Values of all channels of a file, row by row from the top.
class Samples
{
public:
  explicit Samples(const Imath::Box2i& window, float offset = 0.0f)
    : Window(window)
    , Values(5)
  {
    for (int channel = 0; channel < 5; ++channel)
    {
      for (int y = window.min.y; y <= window.max.y; ++y)
      {
        for (int x = window.min.x; x <= window.max.x; ++x)
        {
          this->Add(channel, ValueAt(channel, x, y) + offset);
        }
      }
    }
  }

  Imf::FrameBuffer MakeFrame()
  {
    Imf::FrameBuffer frame;
    for (int channel = 0; channel < 5; ++channel)
    {
      frame.insert(Names[channel],
        Imf::Slice::Make(Types[channel], this->Values[channel].data(), this->Window));
    }
    return frame;
  }

  static void AddChannels(Imf::Header& header)
  {
    for (int channel = 0; channel < 5; ++channel)
    {
      header.channels().insert(Names[channel], Imf::Channel(Types[channel]));
    }
  }

private:
  void Add(int channel, float value)
  {
    const half rounded(value);
    const auto whole = static_cast<unsigned int>(value);
    const void* sample = Types[channel] == Imf::HALF
      ? static_cast<const void*>(&rounded)
      : (Types[channel] == Imf::UINT ? static_cast<const void*>(&whole)
                                     : static_cast<const void*>(&value));
    const std::size_t size = Types[channel] == Imf::HALF ? 2 : 4;
    const auto* bytes = static_cast<const char*>(sample);
    this->Values[channel].insert(this->Values[channel].end(), bytes, bytes + size);
  }

  static constexpr const char* Names[5] = { "R", "G", "B", "Z", "id" };
  static constexpr Imf::PixelType Types[5] = { Imf::HALF, Imf::HALF, Imf::HALF, Imf::FLOAT,
    Imf::UINT };

  Imath::Box2i Window;
  std::vector<std::vector<char>> Values;
};

Imath::Box2i WindowAt(int left, int top)
{
  return { Imath::V2i(left, top), Imath::V2i(left + FileWidth - 1, top + FileHeight - 1) };
}

}

vtkSmartPointer<vtkDataArray> MakeNumbers(
  const std::string& name, int type, int components, vtkIdType tuples, unsigned seed)
{
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::mt19937 random(seed);
  auto* bytes = static_cast<unsigned char*>(array->GetVoidPointer(0));
  for (vtkIdType i = 0; i < tuples * components * array->GetDataTypeSize(); ++i)
  {
    bytes[i] = static_cast<unsigned char>(random());
  }
  return array;
}

vtkSmartPointer<vtkImageData> MakeLayers(int width, int height)
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  const vtkIdType count = image->GetNumberOfPoints();
  vtkPointData* data = image->GetPointData();
  data->AddArray(MakeNumbers("RGBA", VTK_FLOAT, 4, count, 1));
  data->AddArray(MakeNumbers("Z", VTK_FLOAT, 1, count, 2));
  data->AddArray(MakeNumbers("N", VTK_FLOAT, 3, count, 3));
  data->AddArray(MakeNumbers("P", VTK_FLOAT, 3, count, 4));
  data->AddArray(MakeNumbers("forward", VTK_FLOAT, 2, count, 5));
  data->AddArray(MakeNumbers("id", VTK_UNSIGNED_INT, 1, count, 6));
  return image;
}

bool HaveSameBytes(vtkDataArray* a, vtkDataArray* b)
{
  return a && b && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents() &&
    a->GetNumberOfValues() == b->GetNumberOfValues() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
      static_cast<std::size_t>(a->GetNumberOfValues() * a->GetDataTypeSize())) == 0;
}

std::vector<char> ReadBytes(const std::string& name)
{
  std::ifstream stream(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

void WriteBytes(const std::string& name, const std::vector<char>& bytes)
{
  std::ofstream(name, std::ios::binary)
    .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

float ValueAt(int channel, int x, int y)
{
  return static_cast<float>(channel * 100 + (x + 40) + 20 * ((y + 40) % 20));
}

void WriteKind(const std::string& name, const KindOfFile& kind)
{
  const Imath::Box2i window = WindowAt(kind.Left, kind.Top);
  const Imath::Box2i display(Imath::V2i(0, 0), Imath::V2i(FileWidth - 1, FileHeight - 1));
  Imf::Header header(display, window);
  header.compression() = static_cast<Imf::Compression>(kind.Compression);
  header.lineOrder() = kind.Downwards ? Imf::INCREASING_Y : Imf::DECREASING_Y;
  Samples::AddChannels(header);
  Samples samples(window);
  if (!kind.Tiled)
  {
    Imf::OutputFile file(name.c_str(), header);
    file.setFrameBuffer(samples.MakeFrame());
    file.writePixels(FileHeight);
    return;
  }
  header.setTileDescription(
    Imf::TileDescription(8, 4, kind.MipMaps ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
  Imf::TiledOutputFile file(name.c_str(), header);
  file.setFrameBuffer(samples.MakeFrame());
  for (int level = 0; level < file.numLevels(); ++level)
  {
    file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  }
}

void WriteTwoParts(const std::string& name)
{
  const Imath::Box2i window = WindowAt(0, 0);
  std::vector<Imf::Header> headers(2, Imf::Header(window, window));
  headers[0].setName("left");
  headers[1].setName("right");
  for (Imf::Header& header : headers)
  {
    header.setType(Imf::SCANLINEIMAGE);
    Samples::AddChannels(header);
  }
  Imf::MultiPartOutputFile file(name.c_str(), headers.data(), 2);
  for (int i = 0; i < 2; ++i)
  {
    Samples samples(window, 1000.0f * static_cast<float>(i));
    Imf::OutputPart part(file, i);
    part.setFrameBuffer(samples.MakeFrame());
    part.writePixels(FileHeight);
  }
}

void WriteLuminanceChroma(const std::string& name)
{
  constexpr int size = 8;
  Imf::Header header(size, size);
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> samples(3, std::vector<half>(size * size));
  const char* const names[3] = { "Y", "RY", "BY" };
  for (int channel = 0; channel < 3; ++channel)
  {
    const int step = channel == 0 ? 1 : 2, width = size / step;
    for (int i = 0; i < width * width; ++i)
    {
      samples[channel][i] = ValueAt(channel, i % width * step, i / width * step);
    }
    header.channels().insert(names[channel], Imf::Channel(Imf::HALF, step, step));
    frame.insert(names[channel],
      Imf::Slice(Imf::HALF, reinterpret_cast<char*>(samples[channel].data()), 2,
        static_cast<std::size_t>(2 * width), step, step));
  }
  Imf::OutputFile file(name.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(size);
}

void WriteDeep(const std::string& name)
{
  constexpr int size = 4;
  Imf::Header header(size, size);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  std::vector<unsigned int> counts(size * size, 2);
  std::vector<float> values(2 * size * size, 1.5f);
  std::vector<float*> samples;
  for (int i = 0; i < size * size; ++i)
  {
    samples.push_back(&values[2 * i]);
  }
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(
    Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * size));
  frame.insert("Z",
    Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()), sizeof(float*),
      sizeof(float*) * size, sizeof(float)));
  Imf::DeepScanLineOutputFile file(name.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(size);
}
