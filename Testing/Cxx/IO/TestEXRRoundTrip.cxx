// vtkActiveEXRReader reads files of vtkActiveEXRWriter back, and other software finds the layers
// under their conventional names.

#include "IO/EXRFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"

#include "vtkActiveEXRReader.h"
#include "vtkActiveEXRWriter.h"

#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace activesurface;

namespace TestEXRRoundTrip
{

const char* const Layers[] = { "RGBA", "Z", "N", "P", "forward", "id" };

void Write(vtkActiveEXRWriter* writer, vtkImageData* image, const std::string& name)
{
  MessageCapture messages(writer);
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), 0ul) << "ErrorCode of writing " << name;
  EXPECT_TRUE(messages.Errors.empty())
    << (messages.Errors.empty() ? "no error" : messages.Errors[0]);
}

vtkSmartPointer<vtkImageData> Read(const std::string& name)
{
  vtkNew<vtkActiveEXRReader> reader;
  MessageCapture messages(reader);
  reader->SetFileName(name.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0ul) << "ErrorCode of reading " << name;
  EXPECT_TRUE(messages.Errors.empty())
    << (messages.Errors.empty() ? "no error" : messages.Errors[0]);
  return reader->GetOutput();
}

std::string ChannelsOf(const std::string& name)
{
  Imf::InputFile file(name.c_str());
  std::string names;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
  {
    names += std::string(channel.name()) + ":" + std::to_string(channel.channel().type) + " ";
  }
  return names;
}

// The arrays hold random bits, among them NaN and denormal numbers.
TEST(TestEXRRoundTrip, FloatsAndIdsComeBackBitForBit)
{
  const auto image = MakeLayers(37, 35); // more than the 32 rows of PIZ's chunks, not a multiple
  for (int compression : { vtkActiveEXRWriter::NONE, vtkActiveEXRWriter::ZIP,
         vtkActiveEXRWriter::ZIPS, vtkActiveEXRWriter::PIZ })
  {
    vtkNew<vtkActiveEXRWriter> writer;
    writer->SetCompression(compression);
    const std::string name = OutputName("bits.exr");
    Write(writer, image, name);
    const auto copy = Read(name);
    EXPECT_EQ(copy->GetPointData()->GetNumberOfArrays(), 6) << "arrays";
    for (const char* layer : Layers)
    {
      EXPECT_TRUE(HaveSameBytes(
        image->GetPointData()->GetArray(layer), copy->GetPointData()->GetArray(layer)))
        << std::string(layer) << " has the same bytes, compression " << compression;
    }
    EXPECT_TRUE(copy->GetPointData()->GetScalars() == copy->GetPointData()->GetArray("RGBA"))
      << "the picture is the scalars";
  }
}

TEST(TestEXRRoundTrip, WholeNumbersOfSeveralComponentsComeBackBitForBit)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 4, 1);
  image->GetPointData()->AddArray(MakeNumbers("pair", VTK_UNSIGNED_INT, 2, 20, 1));
  vtkNew<vtkActiveEXRWriter> writer;
  const std::string name = OutputName("pairs.exr");
  Write(writer, image, name);
  EXPECT_TRUE(HaveSameBytes(
    Read(name)->GetPointData()->GetArray("pair"), image->GetPointData()->GetArray("pair")))
    << "type, components and bytes";
}

// A half has 11 significant bits. Numbers from 2^-14 on have a relative error of at most 2^-11,
// smaller ones an absolute error of at most 2^-25, half of the least step.
TEST(TestEXRRoundTrip, HalvesAreWithinHalfAStep)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(200, 50, 1);
  vtkNew<vtkFloatArray> numbers;
  numbers->SetName("N");
  numbers->SetNumberOfComponents(3);
  numbers->SetNumberOfTuples(200 * 50);
  for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
  {
    const double sign = i % 2 ? -1.0 : 1.0;
    numbers->SetValue(i, static_cast<float>(sign * std::exp(-18.0 + 29.0 * i / 30000.0)));
  }
  image->GetPointData()->AddArray(numbers);
  vtkNew<vtkActiveEXRWriter> writer;
  writer->AssignPixelType("N", vtkActiveEXRWriter::HALF);
  const std::string name = OutputName("half.exr");
  Write(writer, image, name);
  EXPECT_EQ(ChannelsOf(name), std::string("N.X:1 N.Y:1 N.Z:1 ")) << "types";
  const auto read = Read(name);
  vtkDataArray* copy = read->GetPointData()->GetArray("N");
  for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
  {
    const double value = numbers->GetValue(i);
    const double tolerance = std::max(std::abs(value) / 2048.0, std::ldexp(1.0, -25));
    EXPECT_NEAR(copy->GetComponent(i / 3, static_cast<int>(i % 3)), value, tolerance) << "a half";
  }
}

TEST(TestEXRRoundTrip, FirstRowOfTheFileIsTheTopOfTheImage)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 1);
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Z");
  for (int i = 0; i < 12; ++i)
  {
    heights->InsertNextValue(static_cast<float>(10 * (i / 3) + i % 3)); // 10 y + x
  }
  image->GetPointData()->AddArray(heights);
  vtkNew<vtkActiveEXRWriter> writer;
  const std::string name = OutputName("rows.exr");
  Write(writer, image, name);
  Imf::InputFile file(name.c_str());
  float pixels[12] = {};
  Imf::FrameBuffer frame;
  frame.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels), 4, 12));
  file.setFrameBuffer(frame);
  file.readPixels(0, 3);
  EXPECT_EQ(pixels[0], 30.0f) << "upper left";
  EXPECT_EQ(pixels[2], 32.0f) << "upper right";
  EXPECT_EQ(pixels[9], 0.0f) << "lower left";
  EXPECT_EQ(pixels[11], 2.0f) << "lower right";
}

void AddArray(vtkImageData* image, const std::string& name, int type, int components)
{
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  array->Fill(1.0);
  image->GetPointData()->AddArray(array);
}

TEST(TestEXRRoundTrip, ChannelsFollowTheConvention)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  AddArray(image, "RGB", VTK_DOUBLE, 3);
  AddArray(image, "Z", VTK_DOUBLE, 1);
  AddArray(image, "forward", VTK_FLOAT, 2);
  AddArray(image, "albedo", VTK_UNSIGNED_CHAR, 4);
  AddArray(image, "key", VTK_FLOAT, 4);
  AddArray(image, "id.object", VTK_LONG_LONG, 1);
  AddArray(image, "w", VTK_FLOAT, 11);
  AddArray(image, "P", VTK_FLOAT, 3);
  AddArray(image, "x.of_more_than_the_31_letters_of_old_files", VTK_FLOAT, 1);
  image->GetPointData()->GetArray("P")->SetComponentName(0, "x");
  image->GetPointData()->GetArray("P")->SetComponentName(1, "y");
  image->GetPointData()->GetArray("P")->SetComponentName(2, "z");
  vtkNew<vtkActiveEXRWriter> writer;
  const std::string name = OutputName("names.exr");
  Write(writer, image, name);
  EXPECT_EQ(ChannelsOf(name),
    std::string("B:2 G:2 P.x:2 P.y:2 P.z:2 R:2 Z:2 albedo.A:1 albedo.B:1 albedo.G:1 albedo.R:1 "
                "forward.u:2 forward.v:2 id.object:0 key.A:2 key.B:2 key.G:2 key.R:2 w.00:2 "
                "w.01:2 w.02:2 w.03:2 w.04:2 w.05:2 w.06:2 w.07:2 w.08:2 w.09:2 w.10:2 "
                "x.of_more_than_the_31_letters_of_old_files:2 "))
    << "channels and types";
  const auto copy = Read(name);
  EXPECT_EQ(copy->GetPointData()->GetNumberOfArrays(), 9) << "arrays again";
  EXPECT_EQ(copy->GetPointData()->GetArray("w")->GetNumberOfComponents(), 11) << "numbered ones";
  vtkNew<vtkActiveEXRWriter> again;
  Write(again, copy, OutputName("names_again.exr"));
  EXPECT_EQ(ChannelsOf(OutputName("names_again.exr")).size(), ChannelsOf(name).size()) << "again";

  EXPECT_TRUE((ReadBytes(name)[5] & 4) != 0) << "the file says that it has long names";
}

TEST(TestEXRRoundTrip, UsersNameChannelsThemselves)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  AddArray(image, "P", VTK_FLOAT, 3);
  AddArray(image, "w", VTK_FLOAT, 2);
  AddArray(image, "id", VTK_INT, 1);
  vtkNew<vtkActiveEXRWriter> writer;
  writer->AddChannel("P", 2, "depth.Z");
  writer->AddChannel("P", 0, "depth.X");
  writer->AddChannel("id", 0, "depth.Y");
  writer->AssignPixelType("w", vtkActiveEXRWriter::UINT);
  const std::string name = OutputName("chosen_names.exr");
  Write(writer, image, name);
  EXPECT_EQ(ChannelsOf(name), std::string("depth.X:2 depth.Y:0 depth.Z:2 w.u:0 w.v:0 "))
    << "names and types by the user's choice";
  EXPECT_TRUE((ReadBytes(name)[5] & 4) == 0) << "no long names";
  const auto copy = Read(name);
  for (const char* array : { "depth.X", "depth.Y", "depth.Z", "w" })
  {
    EXPECT_TRUE(copy->GetPointData()->HasArray(array))
      << std::string(array) << ": numbers and ids make no array together";
  }
}

// sRGB's curve is IEC 61966-2-1. The value 188 of 255 is linear light 0.5 within half a step.
TEST(TestEXRRoundTrip, DisplayColorsBecomeLight)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 1, 1);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("ImageScalars");
  colors->SetNumberOfComponents(4);
  for (const int value : { 0, 188, 255 })
  {
    const unsigned char pixel = static_cast<unsigned char>(value);
    const unsigned char tuple[4] = { pixel, pixel, pixel, pixel };
    colors->InsertNextTypedTuple(tuple);
  }
  image->GetPointData()->SetScalars(colors);
  vtkNew<vtkActiveEXRWriter> writer;
  const std::string name = OutputName("colors.exr");
  for (const bool decoded : { false, true })
  {
    writer->SetColorEncoding(decoded ? vtkActiveEXRWriter::SRGB : vtkActiveEXRWriter::LINEAR);
    Write(writer, image, name);
    const auto picture = Read(name);
    vtkDataArray* read = picture->GetPointData()->GetArray("RGBA");
    const double step = 1.0 / 2048.0;
    EXPECT_EQ(read->GetComponent(0, 0), 0.0) << "black";
    EXPECT_EQ(read->GetComponent(2, 1), 1.0) << "white";
    const double light = std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(read->GetComponent(1, 2), decoded ? light : 188.0 / 255.0, step) << "gray";
    EXPECT_NEAR(read->GetComponent(1, 3), 188.0 / 255.0, step) << "alpha stays as it is";
    EXPECT_NEAR(light, 0.5, 0.005) << "light of 188";
  }
}

TEST(TestEXRRoundTrip, DataWindowIsTheExtentWithinTheDisplay)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-2, 4, 3, 11, 0, 0);
  image->GetPointData()->AddArray(MakeNumbers("Z", VTK_FLOAT, 1, image->GetNumberOfPoints(), 7));
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetDisplaySize(10, 9);
  const std::string name = OutputName("windows.exr");
  Write(writer, image, name);
  const Imf::InputFile file(name.c_str());
  EXPECT_TRUE(file.header().dataWindow() == Imath::Box2i(Imath::V2i(-2, -3), Imath::V2i(4, 5)))
    << "data window, downwards";
  EXPECT_TRUE(file.header().displayWindow() == Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(9, 8)))
    << "display window";
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  const int* extent = reader->GetOutput()->GetExtent();
  EXPECT_TRUE(std::equal(extent, extent + 6, image->GetExtent())) << "the same extent again";
  EXPECT_TRUE(HaveSameBytes(
    reader->GetOutput()->GetPointData()->GetArray("Z"), image->GetPointData()->GetArray("Z")))
    << "the same bytes";
  reader->SetWindowToDisplay();
  reader->Update();
  const int display[6] = { 0, 9, 0, 8, 0, 0 };
  extent = reader->GetOutput()->GetExtent();
  EXPECT_TRUE(std::equal(extent, extent + 6, display)) << "the display window's extent";
  vtkImageData* whole = reader->GetOutput();
  const float inside = *static_cast<float*>(image->GetArrayPointer(
    image->GetPointData()->GetArray("Z"), std::array<int, 3>{ 3, 5, 0 }.data()));
  const float cropped = *static_cast<float*>(whole->GetArrayPointer(
    whole->GetPointData()->GetArray("Z"), std::array<int, 3>{ 3, 5, 0 }.data()));
  EXPECT_TRUE(std::memcmp(&inside, &cropped, 4) == 0) << "pixels where both are";
  EXPECT_EQ(whole->GetPointData()->GetArray("Z")->GetComponent(0, 0), 0.0) << "0 where none is";
}

TEST(TestEXRRoundTrip, HeaderComesBackAsFieldData)
{
  const auto image = MakeLayers(4, 3);
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 3, 5.0); // a translation along x
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetTimeCode("01:02:03:04");
  writer->SetFramesPerSecond(23.976);
  writer->SetPixelAspectRatio(2.0);
  writer->SetWorldToCamera(matrix);
  writer->AddAttribute("comments", "a test");
  writer->AddAttribute("owner", "us");
  writer->AddAttribute("motionTime", 0.25);
  const std::string name = OutputName("header.exr");
  Write(writer, image, name);
  const auto copy = Read(name);
  vtkFieldData* data = copy->GetFieldData();
  const auto text = [data](const char* attribute)
  {
    auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(attribute));
    return array ? std::string(array->GetValue(0)) : "nothing";
  };
  const auto number = [data](const char* attribute, int i)
  {
    vtkDataArray* array = data->GetArray(attribute);
    return array ? array->GetComponent(0, i) : std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_EQ(text("timeCode"), std::string("01:02:03:04")) << "timeCode";
  EXPECT_EQ(text("comments"), std::string("a test")) << "comments";
  EXPECT_EQ(text("owner"), std::string("us")) << "owner";
  EXPECT_EQ(text("compression"), std::string("zip")) << "compression";
  EXPECT_EQ(number("motionTime", 0), 0.25) << "a number";
  EXPECT_EQ(number("framesPerSecond", 0), 24000.0) << "24000 / 1001";
  EXPECT_EQ(number("framesPerSecond", 1), 1001.0) << "24000 / 1001";
  EXPECT_EQ(number("pixelAspectRatio", 0), 2.0) << "pixel aspect";
  EXPECT_EQ(number("worldToCamera", 3), 5.0) << "a matrix as VTK has it";
  const Imf::InputFile file(name.c_str());
  EXPECT_TRUE(text("software").find("Active Implicit Surfaces") == 0) << "software";
}

TEST(TestEXRRoundTrip, ListsOfNumbersMayBeEmpty)
{
  Imf::Header header(1, 1);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.insert("none", Imf::FloatVectorAttribute());
  header.insert("two", Imf::FloatVectorAttribute({ 1.5f, -2.0f }));
  float pixel = 3.0f;
  Imf::FrameBuffer frame;
  frame.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&pixel), 4, 4));
  const std::string name = OutputName("lists.exr");
  {
    Imf::OutputFile file(name.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(1);
  }
  const auto copy = Read(name);
  ASSERT_TRUE(copy->GetFieldData()->GetArray("none"));
  EXPECT_EQ(copy->GetFieldData()->GetArray("none")->GetNumberOfTuples(), 0);
  EXPECT_EQ(copy->GetFieldData()->GetArray("two")->GetComponent(0, 0), 1.5);
  EXPECT_EQ(copy->GetFieldData()->GetArray("two")->GetComponent(0, 1), -2.0);
}

}
