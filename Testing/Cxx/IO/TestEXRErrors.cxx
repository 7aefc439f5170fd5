// A failed write or read gives one error message and an ErrorCode. No partial file and no stale
// output remain.

#include "IO/EXRFiles.h"
#include "IO/ReadRefused.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"
#include "Support/SmallDisk.h"

#include "vtkActiveEXRReader.h"
#include "vtkActiveEXRWriter.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestEXRErrors
{

using std::filesystem::path;

void CheckWriteRefused(
  vtkActiveEXRWriter* writer, unsigned long code, const std::string& words, const std::string& what)
{
  MessageCapture messages(writer);
  writer->Write();
  const unsigned long told = writer->GetErrorCode();
  EXPECT_EQ(told, code) << "ErrorCode of " << what;
  EXPECT_EQ(messages.Errors.size(), 1u) << "errors of " << what;
  const std::string sentence = messages.Errors.empty() ? "" : messages.Errors[0];
  EXPECT_TRUE(sentence.find(words) != std::string::npos) << what << ": " << sentence;
}

vtkSmartPointer<vtkImageData> MakeImageOf(int type, double value)
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(3, 2, 1);
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName("X");
  array->SetNumberOfTuples(6);
  array->Fill(0.0);
  array->SetComponent(4, 0, value);
  image->GetPointData()->AddArray(array);
  return image;
}

TEST(TestEXRErrors, ValuesThatDoNotFitAreRefused)
{
  const path folder = EmptyFolder("fit");
  struct Case
  {
    int Array;
    double Value;
    int Pixel;
    bool Fits;
  };
  using Writer = vtkActiveEXRWriter;
  const double inf = std::numeric_limits<double>::infinity();
  const Case cases[] = { { VTK_FLOAT, 65504, Writer::HALF, true },
    { VTK_FLOAT, 65520, Writer::HALF, false }, { VTK_FLOAT, -1e9, Writer::HALF, false },
    { VTK_FLOAT, inf, Writer::HALF, true }, { VTK_DOUBLE, 1e300, Writer::FLOAT, false },
    { VTK_DOUBLE, inf, Writer::FLOAT, true }, { VTK_DOUBLE, 0.1, Writer::FLOAT, true },
    { VTK_INT, -1, Writer::UINT, false }, { VTK_LONG_LONG, 4294967295.0, Writer::UINT, true },
    { VTK_LONG_LONG, 4294967296.0, Writer::UINT, false }, { VTK_FLOAT, 0.5, Writer::UINT, false },
    { VTK_DOUBLE, 7, Writer::UINT, true }, { VTK_INT, 16777217, Writer::FLOAT, false },
    { VTK_INT, 16777216, Writer::FLOAT, true }, { VTK_DOUBLE, 1e-9, Writer::UINT, false } };
  for (const Case& tried : cases)
  {
    const std::string what = std::to_string(tried.Value) + " as " + std::to_string(tried.Pixel);
    vtkNew<vtkActiveEXRWriter> writer;
    writer->SetInputData(MakeImageOf(tried.Array, tried.Value));
    writer->SetFileName((folder / "a.exr").c_str());
    writer->AssignPixelType("X", tried.Pixel);
    if (tried.Fits)
    {
      writer->Write();
      EXPECT_EQ(writer->GetErrorCode(), 0ul) << what;
      std::filesystem::remove(folder / "a.exr");
    }
    else
    {
      std::ostringstream words;
      words << std::setprecision(10) << "Value " << tried.Value << " of array \"X\" does not fit";
      CheckWriteRefused(writer, vtkErrorCode::UserError, words.str(), what);
    }
    EXPECT_EQ(CountFiles(folder), 0u) << "files left by " << what;
  }
}

TEST(TestEXRErrors, InputsThatAreNoPictureAreRefused)
{
  const path folder = EmptyFolder("inputs");
  const std::string name = folder / "a.exr";
  vtkNew<vtkActiveEXRWriter> writer;
  CheckWriteRefused(writer, vtkErrorCode::UserError, "no input", "no input");
  const auto image = MakeImageOf(VTK_FLOAT, 1);
  writer->SetInputData(image);
  CheckWriteRefused(writer, vtkErrorCode::NoFileNameError, "FileName", "no name");
  writer->SetFileName(name.c_str());

  vtkNew<vtkImageData> volume;
  volume->SetDimensions(2, 3, 4);
  volume->AllocateScalars(VTK_FLOAT, 1);
  writer->SetInputData(volume);
  CheckWriteRefused(writer, vtkErrorCode::UserError, "2 x 3 x 4", "a volume");
  vtkNew<vtkImageData> empty;
  writer->SetInputData(empty);
  CheckWriteRefused(writer, vtkErrorCode::UserError, "empty", "an empty image");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(3, 2, 1);
  writer->SetInputData(bare);
  CheckWriteRefused(writer, vtkErrorCode::UserError, "no numeric point array", "no array");

  writer->SetInputData(image);
  writer->SetCompressionToDWAA();
  CheckWriteRefused(writer, vtkErrorCode::UserError, "DWAA", "data with loss");
  writer->SetCompressionToZIP();
  writer->SetTimeCode("25:00:00:00");
  CheckWriteRefused(writer, vtkErrorCode::UserError, "TimeCode", "a 25th hour");
  writer->SetTimeCode("01:00:00:30");
  CheckWriteRefused(writer, vtkErrorCode::UserError, "up to 23:59:59:29", "a 31st frame");
  writer->SetTimeCode("noon");
  CheckWriteRefused(writer, vtkErrorCode::UserError, "TimeCode", "no time code");
  writer->SetTimeCode(nullptr);
  writer->SetDisplaySize(5, -1);
  CheckWriteRefused(writer, vtkErrorCode::UserError, "DisplaySize", "no display");
  writer->SetDisplaySize(0, 0);
  writer->AddChannel("absent", 0, "Z");
  CheckWriteRefused(writer, vtkErrorCode::UserError, "absent", "a missing array");
  writer->ClearChannels();
  writer->AddChannel("X", 0, "Z");
  writer->AddChannel("X", 0, "Z");
  CheckWriteRefused(writer, vtkErrorCode::UserError, "channel Z", "two channels of a name");
  writer->ClearChannels();
  writer->AddAttribute("compression", 3.0);
  CheckWriteRefused(writer, vtkErrorCode::UnknownError, "compression", "an attribute's type");
  EXPECT_EQ(CountFiles(folder), 0u) << "files";
  writer->ClearAttributes();
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), 0ul) << "all well again";
}

TEST(TestEXRErrors, PicturesPassWithLoss)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(64, 64, 1);
  const auto colors = MakeNumbers("RGBA", VTK_FLOAT, 4, 64 * 64, 1);
  colors->Fill(0.5);
  image->GetPointData()->AddArray(colors);
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(OutputName("dwaa.exr").c_str());
  writer->AssignPixelType("RGBA", vtkActiveEXRWriter::HALF);
  writer->SetCompressionToDWAA();
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), 0ul) << "ErrorCode";
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(writer->GetFileName());
  reader->Update();
  EXPECT_NEAR(reader->GetOutput()->GetPointData()->GetArray("RGBA")->GetComponent(99, 1), 0.5, 0.01)
    << "about the same";
}

TEST(TestEXRErrors, FoldersThatCannotBeWrittenAreTold)
{
  const path folder = EmptyFolder("places");
  std::filesystem::create_directory(folder / "taken.exr");
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputData(MakeImageOf(VTK_FLOAT, 1));
  writer->SetFileName((folder / "absent" / "a.exr").c_str());
  CheckWriteRefused(writer, vtkErrorCode::CannotOpenFileError, "No such file", "a missing folder");
  writer->SetFileName((folder / "taken.exr").c_str());
  CheckWriteRefused(
    writer, vtkErrorCode::CannotOpenFileError, "folder, device or pipe", "a folder in its place");
  writer->SetFileName("/proc/a.exr"); // not writable even for root
  CheckWriteRefused(writer, vtkErrorCode::CannotOpenFileError, "a.exr", "an unwritable one");
  // A pipe stands for devices, which a failing test would delete.
  const path pipe = folder / "pipe.exr";
  EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0) << "a pipe is made";
  writer->SetFileName(pipe.c_str());
  CheckWriteRefused(writer, vtkErrorCode::CannotOpenFileError, "folder, device or pipe", "a pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe)) << "the pipe is as it was";
  EXPECT_EQ(CountFiles(folder), 2u) << "nothing else is left";
}

// A limit on the size of files simulates a full disk.
TEST(TestEXRErrors, FullDiskLeavesTheOldFile)
{
  const path folder = EmptyFolder("full");
  const std::string name = folder / "a.exr";
  WriteBytes(name, { 'o', 'l', 'd' });
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputData(MakeLayers(100, 100));
  writer->SetFileName(name.c_str());
  for (const rlim_t size : { 10, 1000, 5000, 300000 }) // in the header, the first and last rows
  {
    {
      const activesurface::SmallDisk disk(size);
      CheckWriteRefused(writer, vtkErrorCode::OutOfDiskSpaceError, "File too large",
        "a disk of " + std::to_string(size) + " bytes");
    }
    EXPECT_EQ(CountFiles(folder), 1u) << "files";
    EXPECT_TRUE(ReadBytes(name) == std::vector<char>({ 'o', 'l', 'd' })) << "the old file is whole";
  }
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), 0ul) << "with space, it is written";
  EXPECT_GT(static_cast<double>(ReadBytes(name).size()), 3.0e5) << "all of it";
}

TEST(TestEXRErrors, FilesThatAreNoneAreRefused)
{
  const path folder = EmptyFolder("none");
  const std::string good = folder / "good.exr", bad = folder / "bad.exr";
  WriteKind(good, {});
  const std::vector<char> bytes = ReadBytes(good);
  vtkNew<vtkActiveEXRReader> reader;
  const auto refuse = [&](const std::string& name, unsigned long code, const std::string& words)
  {
    reader->SetFileName(good.c_str());
    reader->Update();
    EXPECT_GT(static_cast<double>(reader->GetOutput()->GetNumberOfPoints()), 0.0) << "good first";
    reader->SetFileName(name.c_str());
    CheckReadRefused(reader, code, words, words);
  };
  CheckReadRefused(reader, vtkErrorCode::NoFileNameError, "FileName", "no name");
  refuse(folder / "absent.exr", vtkErrorCode::FileNotFoundError, "no such file");
  refuse(folder, vtkErrorCode::CannotOpenFileError, "a folder");
  WriteBytes(bad, {});
  refuse(bad, vtkErrorCode::UnrecognizedFileTypeError, "no EXR file");
  WriteBytes(bad, std::vector<char>(1000, 'x'));
  refuse(bad, vtkErrorCode::UnrecognizedFileTypeError, "no EXR file");
  WriteBytes(bad, std::vector<char>(bytes.begin(), bytes.begin() + 100));
  refuse(bad, vtkErrorCode::FileFormatError, "larger than the rest of the file");
  WriteBytes(bad, std::vector<char>(bytes.begin(), bytes.end() - 100));
  refuse(bad, vtkErrorCode::PrematureEndOfFileError, "ends too early");
  WriteDeep(bad);
  refuse(bad, vtkErrorCode::FileFormatError, "deep data");
  std::vector<char> changed = bytes;
  changed[4] = 3;
  WriteBytes(bad, changed);
  refuse(bad, vtkErrorCode::FileFormatError, "version of the EXR format");
  changed = bytes;
  const std::string type = "box2i";
  *std::search(changed.begin(), changed.end(), type.begin(), type.end()) = 'B';
  WriteBytes(bad, changed);
  refuse(bad, vtkErrorCode::FileFormatError, "attribute \"dataWindow\"");
}

// Image with two or four time steps. The third of four is empty.
class Clock : public vtkImageAlgorithm
{
public:
  static Clock* New();
  vtkTypeMacro(Clock, vtkImageAlgorithm);
  int Steps = 4;
  bool Fails = false; // at the time 1

protected:
  Clock() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* information = outputs->GetInformationObject(0);
    const double times[4] = { 0, 0.5, 1, 1.5 };
    const int whole[6] = { 0, 2, 0, 1, 0, 0 };
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, this->Steps);
    const double range[2] = { 0, 1.5 };
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole, 6);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* information = outputs->GetInformationObject(0);
    const double time = information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    vtkImageData* image = vtkImageData::GetData(information);
    image->ShallowCopy(MakeImageOf(VTK_FLOAT, time));
    image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    if (time == 1 && this->Steps == 4)
    {
      image->Initialize();
    }
    return time == 1 && this->Fails ? 0 : 1;
  }
};
vtkStandardNewMacro(Clock);

TEST(TestEXRErrors, AllTimeStepsAreWritten)
{
  const path folder = EmptyFolder("steps");
  vtkNew<Clock> clock;
  clock->Steps = 2;
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputConnection(clock->GetOutputPort());
  writer->SetFileName((folder / "a.exr").c_str());
  writer->WriteAllTimeStepsOn();
  writer->Write();
  EXPECT_EQ(CountFiles(folder), 2u) << "files";
  for (int step = 0; step < 2; ++step)
  {
    vtkNew<vtkActiveEXRReader> reader;
    reader->SetFileName((folder / ("a.000" + std::to_string(step) + ".exr")).c_str());
    reader->Update();
    vtkDataArray* array = reader->GetOutput()->GetPointData()->GetArray("X");
    EXPECT_TRUE(array && array->GetComponent(4, 0) == 0.5 * step) << "its time step";
    vtkDataArray* time = reader->GetOutput()->GetFieldData()->GetArray("time");
    EXPECT_TRUE(time && time->GetComponent(0, 0) == 0.5 * step) << "its time";
  }
  writer->SetFileName((folder / "b%03d.exr").c_str());
  writer->SetFrameNumber(10);
  writer->Write();
  EXPECT_TRUE(std::filesystem::exists(folder / "b011.exr")) << "numbered from FrameNumber";

  clock->Steps = 4;
  clock->Modified();
  writer->SetFileName((folder / "c.exr").c_str());
  CheckWriteRefused(writer, vtkErrorCode::UserError, "empty", "a step that is not there");
  EXPECT_TRUE(std::filesystem::exists(folder / "c.0011.exr")) << "those before are there";
  EXPECT_FALSE(std::filesystem::exists(folder / "c.0013.exr")) << "it stops";

  clock->Fails = true;
  clock->Modified();
  writer->SetFileName((folder / "d.exr").c_str());
  CheckWriteRefused(
    writer, vtkErrorCode::UnknownError, "update of the input failed", "a step that fails");
  EXPECT_TRUE(std::filesystem::exists(folder / "d.0011.exr")) << "those before are there";
  EXPECT_FALSE(std::filesystem::exists(folder / "d.0012.exr")) << "it stops";
}

}
