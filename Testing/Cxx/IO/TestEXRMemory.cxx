// A file that needs more memory than allowed is refused before its pixels are allocated.

#include "IO/EXRFiles.h"
#include "IO/ReadRefused.h"
#include "Support/OutputFiles.h"

#include "vtkActiveEXRReader.h"
#include "vtkActiveEXRWriter.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestEXRMemory
{

// The numbers of the data window's last column and row grow by 2^28.
TEST(TestEXRMemory, AbsurdSizesAreRefusedBeforeTheyAreAllocated)
{
  const std::string name = OutputName("absurd.exr");
  WriteKind(name, {});
  std::vector<char> bytes = ReadBytes(name);
  const std::string window = "dataWindow";
  const auto found = std::search(bytes.begin(), bytes.end(), window.begin(), window.end());
  const auto numbers = found + 10 + 1 + 6 + 4; // its name, its type and its size
  numbers[11] = numbers[15] = 0x10;
  WriteBytes(name, bytes);
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(name.c_str());
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  CheckReadRefused(reader, vtkErrorCode::FileFormatError, "no file of", "a huge window");
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT((after.ru_maxrss - before.ru_maxrss) / 1024.0, 16.0) << "MiB";
}

// The image of 600 x 600 pixels and 14 channels has 19.2 MiB, and 16 of its lines have 0.5 MiB.
TEST(TestEXRMemory, MoreThanMaximumMemoryIsRefused)
{
  const std::string name = OutputName("large.exr");
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputData(MakeLayers(600, 600));
  writer->SetFileName(name.c_str());
  writer->Write();
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(name.c_str());
  reader->SetMaximumMemory(19);
  CheckReadRefused(reader, vtkErrorCode::UserError, "MaximumMemory", "a small limit");
  reader->SetMaximumMemory(21); // three times the lines
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0ul) << "a larger one";
}

// With PIZ, OpenEXR unpacks 32 lines at a time: 49 MiB here, although the image has only one line,
// of 1.5 MiB.
TEST(TestEXRMemory, LinesBeyondMaximumMemoryAreRefused)
{
  const std::string name = OutputName("wide.exr");
  vtkNew<vtkImageData> image;
  image->SetDimensions(100000, 1, 1);
  image->GetPointData()->AddArray(MakeNumbers("RGBA", VTK_FLOAT, 4, 100000, 1));
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->SetCompressionToPIZ();
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), 0ul) << "written";
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(name.c_str());
  reader->SetMaximumMemory(40);
  CheckReadRefused(reader, vtkErrorCode::UserError, "MaximumMemory", "less than its lines");
  reader->SetMaximumMemory(150); // three times the lines, and the pixels
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0ul) << "enough";
}

}
