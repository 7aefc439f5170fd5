// Information that vtkActiveEXRReader provides to the pipeline, and requests of vtkActiveEXRWriter.

#include "IO/EXRFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"

#include "vtkActiveEXRReader.h"
#include "vtkActiveEXRWriter.h"

#include <gtest/gtest.h>
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
#include <functional>
#include <string>

namespace TestEXRPipeline
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr int Whole[6] = { 0, 6, 0, 4, 0, 0 };

class Part : public vtkImageAlgorithm
{
public:
  static Part* New();
  vtkTypeMacro(Part, vtkImageAlgorithm);

  bool Fails = false;

protected:
  Part() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    outputs->GetInformationObject(0)->Set(Pipeline::WHOLE_EXTENT(), Whole, 6);
    return this->Fails ? 0 : 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* information = outputs->GetInformationObject(0);
    vtkImageData* image = vtkImageData::GetData(information);
    image->SetExtent(information->Get(Pipeline::UPDATE_EXTENT()));
    image->AllocateScalars(VTK_FLOAT, 1);
    image->GetPointData()->GetScalars()->SetName("Z");
    image->GetPointData()->GetScalars()->Fill(0.0);
    return 1;
  }
};
vtkStandardNewMacro(Part);

}

TEST(TestEXRPipeline, SpacingIsThatOfTheReader)
{
  const std::string name = OutputName("a.exr");
  WriteKind(name, {});
  const double spacing[3] = { 0.5, 0.25, 2.0 };
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetFileName(name.c_str());
  reader->SetDataSpacing(spacing);
  reader->UpdateInformation();
  const double* told = reader->GetOutputInformation(0)->Get(vtkDataObject::SPACING());
  EXPECT_TRUE(told && std::equal(spacing, spacing + 3, told)) << "before it is read";
  reader->Update();
  EXPECT_TRUE(std::equal(spacing, spacing + 3, reader->GetOutput()->GetSpacing())) << "when read";
}

// Another consumer of the same image may have requested a part of it before.
TEST(TestEXRPipeline, TheWholeImageIsWritten)
{
  const std::string name = OutputName("whole.exr");
  const int corner[6] = { 1, 2, 1, 2, 0, 0 };
  vtkNew<Part> source;
  vtkNew<vtkActiveEXRWriter> writer;
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName(name.c_str());
  const auto countWritten = [&](const std::function<void()>& write)
  {
    std::filesystem::remove(name);
    source->Modified();
    source->UpdateExtent(corner);
    EXPECT_EQ(static_cast<int>(source->GetOutput()->GetNumberOfPoints()), 4) << "pixels before";
    write();
    vtkNew<vtkActiveEXRReader> reader;
    reader->SetFileName(name.c_str());
    reader->Update();
    return static_cast<int>(reader->GetOutput()->GetNumberOfPoints());
  };
  EXPECT_EQ(countWritten([&] { writer->Write(); }), 35) << "pixels written";
  EXPECT_EQ(countWritten([&] { writer->Update(); }), 35) << "pixels written by an update";
}

TEST(TestEXRPipeline, AnInputThatFailsIsNotWritten)
{
  const std::string name = OutputName("failed.exr");
  vtkNew<Part> source;
  vtkNew<vtkActiveEXRWriter> writer;
  const MessageCapture errors(writer), ofSource(source);
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName(name.c_str());
  for (const bool fails : { true, false, true })
  {
    std::filesystem::remove(name);
    source->Fails = fails;
    source->Modified();
    writer->Write();
    EXPECT_EQ(std::filesystem::exists(name), !fails);
    EXPECT_EQ(writer->GetErrorCode() != vtkErrorCode::NoError, fails);
  }
}

}
