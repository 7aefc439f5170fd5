// Reads files of several kinds written by OpenEXR itself, and series of files.

#include "IO/EXRFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"

#include "vtkActiveEXRReader.h"
#include "vtkActiveEXRWriter.h"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkImageReader2Factory.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>

#include <array>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestEXRReader
{

double At(vtkImageData* image, const char* array, int component, int x, int y)
{
  std::array<int, 3> place{ x, y, 0 };
  return image->GetPointData()->GetArray(array)->GetComponent(
    image->ComputePointId(place.data()), component);
}

// Compares all channels with ValueAt plus `offset`.
void CheckPixels(vtkImageData* image, double offset, const std::string& what)
{
  int extent[6];
  image->GetExtent(extent);
  EXPECT_EQ((extent[1] - extent[0] + 1) * (extent[3] - extent[2] + 1), FileWidth * FileHeight)
    << "pixels of " << what;
  int wrong = 0;
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    for (int x = extent[0]; x <= extent[1]; ++x)
    {
      const int row = FileHeight - 1 - y; // downwards in the file
      for (int i = 0; i < 3; ++i)
      {
        wrong += At(image, "RGB", i, x, y) != ValueAt(i, x, row) + offset;
      }
      wrong += At(image, "Z", 0, x, y) != ValueAt(3, x, row) + offset;
      wrong += At(image, "id", 0, x, y) != ValueAt(4, x, row) + offset;
    }
  }
  EXPECT_EQ(wrong, 0) << "wrong samples of " << what;
  EXPECT_EQ(image->GetPointData()->GetArray("id")->GetDataType(), VTK_UNSIGNED_INT) << "ids";
  EXPECT_EQ(image->GetPointData()->GetArray("RGB")->GetDataType(), VTK_FLOAT) << "colors";
}

TEST(TestEXRReader, EveryKindOfFileIsReadRight)
{
  int number = 0;
  for (const bool tiled : { false, true })
  {
    for (const int compression : { 0, 1, 2, 3, 4 }) // all lossless ones
    {
      for (const bool downwards : { true, false })
      {
        KindOfFile kind;
        kind.Tiled = tiled;
        kind.MipMaps = compression % 2 == 1;
        kind.Compression = compression;
        kind.Downwards = downwards;
        kind.Left = number % 3 - 1;
        kind.Top = 2 - number % 5;
        ++number;
        const std::string name = OutputName("kind.exr");
        WriteKind(name, kind);
        vtkNew<vtkActiveEXRReader> reader;
        reader->SetFileName(name.c_str());
        reader->Update();
        CheckPixels(reader->GetOutput(), 0.0, "kind " + std::to_string(number));
      }
    }
  }
}

TEST(TestEXRReader, PartsAreChosenByNumber)
{
  const std::string name = OutputName("parts.exr");
  WriteTwoParts(name);
  vtkNew<vtkActiveEXRReader> reader;
  MessageCapture messages(reader);
  reader->SetFileName(name.c_str());
  for (int part = 0; part < 2; ++part)
  {
    reader->SetPart(part);
    reader->Update();
    CheckPixels(reader->GetOutput(), 1000.0 * part, "part " + std::to_string(part));
  }
  EXPECT_EQ(reader->GetNumberOfParts(), 2) << "parts";
  EXPECT_EQ(std::string(reader->GetPartName(1)), std::string("right")) << "name";
  EXPECT_EQ(std::string(reader->GetPartType(1)), std::string("scanlineimage")) << "type";
  EXPECT_TRUE(reader->GetPartName(2) == nullptr) << "no third";
  reader->SetPart(2);
  reader->Update();
  EXPECT_EQ(messages.Errors.size(), 1u) << "errors";
  EXPECT_TRUE(!messages.Errors.empty() && messages.Errors[0].find("Part 2") != std::string::npos)
    << "named";
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), vtkIdType(0)) << "nothing stale";
}

TEST(TestEXRReader, ChannelsAreListedAndChosen)
{
  const std::string name = OutputName("chosen.exr");
  WriteKind(name, {});
  vtkNew<vtkActiveEXRReader> reader;
  MessageCapture messages(reader);
  reader->SetFileName(name.c_str());
  reader->UpdateInformation();
  std::string channels;
  for (int i = 0; i < reader->GetNumberOfChannels(); ++i)
  {
    channels += reader->GetChannelName(i) + std::to_string(reader->GetChannelType(i)) + " ";
  }
  EXPECT_EQ(channels, std::string("B1 G1 R1 Z2 id0 ")) << "channels and types";
  EXPECT_EQ(reader->GetChannelType(5), -1) << "no sixth";
  reader->DisableChannel("G");
  reader->Update();
  vtkPointData* data = reader->GetOutput()->GetPointData();
  EXPECT_EQ(data->GetNumberOfArrays(), 4) << "B, R, Z, id";
  EXPECT_TRUE(data->HasArray("B") && data->HasArray("R") && !data->HasArray("G"))
    << "single colors";
  reader->DisableAllChannels();
  reader->EnableChannel("Z");
  reader->Update();
  EXPECT_EQ(data->GetNumberOfArrays(), 1) << "Z alone";
  reader->DisableChannel("Z");
  reader->Update();
  EXPECT_EQ(messages.Errors.size(), 1u) << "none is an error";
  reader->EnableAllChannels();
  reader->Update();
  CheckPixels(reader->GetOutput(), 0.0, "all again");
}

TEST(TestEXRReader, ChromaIsRepeatedOverItsPixels)
{
  const std::string name = OutputName("chroma.exr");
  WriteLuminanceChroma(name);
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  int wrong = 0;
  for (int y = 0; y < 8; ++y)
  {
    for (int x = 0; x < 8; ++x)
    {
      const int row = 7 - y;
      wrong += At(reader->GetOutput(), "Y", 0, x, y) != ValueAt(0, x, row);
      wrong += At(reader->GetOutput(), "RY", 0, x, y) != ValueAt(1, x / 2 * 2, row / 2 * 2);
      wrong += At(reader->GetOutput(), "BY", 0, x, y) != ValueAt(2, x / 2 * 2, row / 2 * 2);
    }
  }
  EXPECT_EQ(wrong, 0) << "wrong samples";
}

std::vector<double> TimesOf(vtkActiveEXRReader* reader)
{
  vtkInformation* information = reader->GetOutputInformation(0);
  const auto key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  const int count = information->Has(key) ? information->Length(key) : 0;
  const double* times = count ? information->Get(key) : nullptr;
  return std::vector<double>(times, times + count);
}

TEST(TestEXRReader, FilesAreTimeSteps)
{
  vtkNew<vtkStringArray> names;
  for (int i = 0; i < 3; ++i)
  {
    const auto image = MakeLayers(4, 3);
    image->GetPointData()->GetArray("Z")->Fill(i);
    image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), 0.5 * i + 0.25);
    vtkNew<vtkActiveEXRWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(OutputName("step.##.exr").c_str());
    writer->SetFrameNumber(i + 7);
    writer->Write();
    names->InsertNextValue(OutputName("step.0" + std::to_string(i + 7) + ".exr"));
  }
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileNames(names);
  reader->UpdateInformation();
  EXPECT_TRUE(TimesOf(reader) == std::vector<double>({ 0.25, 0.75, 1.25 }))
    << "times of the headers";
  const std::vector<std::pair<double, double>> asked = { { 0.75, 1 }, { 0.25, 0 }, { 1.2, 1 },
    { -5, 0 }, { 99, 2 }, { 1.25, 2 } };
  for (const auto& [time, step] : asked)
  {
    reader->UpdateTimeStep(time);
    EXPECT_EQ(At(reader->GetOutput(), "Z", 0, 1, 1), step) << "at " << time;
  }
  vtkNew<vtkActiveEXRReader> other;
  other->AddFileName(names->GetValue(2).c_str());
  other->ClearFileNames();
  for (int i = 0; i < 2; ++i)
  {
    other->AddFileName(names->GetValue(i).c_str());
  }
  other->UpdateInformation();
  EXPECT_TRUE(TimesOf(other) == std::vector<double>({ 0.25, 0.75 })) << "files one by one";
  names->InsertNextValue(names->GetValue(0)); // times that do not increase
  reader->Modified();
  reader->UpdateInformation();
  EXPECT_TRUE(TimesOf(reader) == std::vector<double>({ 0, 1, 2, 3 })) << "numbers, else";
}

TEST(TestEXRReader, FilesOfASeriesMayHaveOtherWindows)
{
  vtkNew<vtkStringArray> names;
  for (int i = 0; i < 2; ++i)
  {
    KindOfFile kind;
    kind.Left = 5 * i;
    names->InsertNextValue(OutputName("shifted" + std::to_string(i) + ".exr"));
    WriteKind(names->GetValue(i), kind);
  }
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileNames(names);
  reader->UpdateTimeStep(1);
  int extent[6];
  reader->GetOutput()->GetExtent(extent);
  EXPECT_EQ(extent[1], FileWidth - 1 + 5) << "one extent for both";
  EXPECT_EQ(At(reader->GetOutput(), "Z", 0, 0, 0), 0.0) << "nothing there in the second";
  EXPECT_EQ(At(reader->GetOutput(), "Z", 0, 5, 0), double(ValueAt(3, 5, FileHeight - 1)))
    << "pixel";
}

TEST(TestEXRReader, FactoryKnowsTheReader)
{
  vtkActiveEXRReader::RegisterWithFactory();
  vtkActiveEXRReader::RegisterWithFactory();
  const std::string name = OutputName("factory.exr");
  WriteKind(name, {});
  const auto found = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(name.c_str()));
  EXPECT_TRUE(vtkActiveEXRReader::SafeDownCast(found) != nullptr) << "the reader for the file";
  vtkNew<vtkActiveEXRReader> reader;
  EXPECT_EQ(reader->CanReadFile(name.c_str()), 3) << "a file of its kind";
  EXPECT_EQ(reader->CanReadFile("/absent.exr"), 0) << "no file";
  EXPECT_EQ(reader->CanReadFile(nullptr), 0) << "no name";
  EXPECT_EQ(std::string(reader->GetFileExtensions()), std::string(".exr")) << "extension";
}

}
