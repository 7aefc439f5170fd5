// Information that vtkActiveVDBReader provides to the pipeline, its PrintSelf, and the ErrorCode of
// vtkActiveVDBWriter.

#include "IO/GridFiles.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"
#include "Support/PipelineTools.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>

using namespace activesurface;

namespace TestVDBPipeline
{

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace
{

std::string SaveAt(const std::string& folder, double time)
{
  const std::string file = folder + std::to_string(time) + ".vdb";
  auto grid = openvdb::FloatGrid::create();
  grid->setName("a");
  grid->tree().setValue(openvdb::Coord(0), 1.f);
  grid->insertMeta("time", openvdb::DoubleMetadata(time));
  Save(file, { grid });
  return file;
}

}

TEST(TestVDBPipeline, DataTellTheTimeOfTheirFile)
{
  const std::string folder = EmptyFolder("times");
  vtkNew<vtkActiveVDBReader> reader;
  for (const double time : { 1.5, 2.0, 4.0 })
  {
    reader->AddFileName(SaveAt(folder, time).c_str());
  }
  for (const auto& [asked, time] : { std::pair{ 3.9, 2.0 }, { 4.0, 4.0 }, { 0.0, 1.5 } })
  {
    reader->UpdateTimeStep(asked);
    vtkInformation* data = reader->GetOutputDataObject(0)->GetInformation();
    EXPECT_EQ(data->Get(vtkDataObject::DATA_TIME_STEP()), time) << "asked for " << asked;
  }
}

TEST(TestVDBPipeline, OneFileHasNoTimeStepsAfterASeries)
{
  const std::string folder = EmptyFolder("times");
  vtkNew<vtkActiveVDBReader> reader;
  reader->AddFileName(SaveAt(folder, 1.5).c_str());
  reader->AddFileName(SaveAt(folder, 2.0).c_str());
  reader->UpdateInformation();
  vtkInformation* told = reader->GetOutputInformation(0);
  EXPECT_EQ(told->Length(SDDP::TIME_STEPS()), 2) << "steps of the series";
  reader->SetFileName(SaveAt(folder, 4.0).c_str());
  reader->UpdateInformation();
  EXPECT_FALSE(told->Has(SDDP::TIME_STEPS())) << "steps of one file";
  EXPECT_FALSE(told->Has(SDDP::TIME_RANGE())) << "their range";
}

// Outputs are images or points, always a vtkDataSet.
TEST(TestVDBPipeline, ThePortTellsWhatItMakes)
{
  vtkNew<vtkActiveVDBReader> reader;
  EXPECT_EQ(std::string(reader->GetOutputPortInformation(0)->Get(vtkDataObject::DATA_TYPE_NAME())),
    "vtkDataSet");
}

TEST(TestVDBPipeline, PrintShowsAlsoWhatEveryAlgorithmHas)
{
  vtkNew<vtkActiveVDBReader> reader;
  reader->SetFileName("a.vdb");
  std::ostringstream text;
  reader->Print(text);
  EXPECT_TRUE(text.str().find("FileName: a.vdb") != std::string::npos) << text.str();
  EXPECT_TRUE(text.str().find("Modified Time: ") != std::string::npos) << text.str();
}

TEST(TestVDBPipeline, AWriterThatSucceedsForgetsItsError)
{
  const std::string folder = EmptyFolder("codes");
  auto ball = MakeShrinkingBall();
  vtkNew<vtkActiveVDBWriter> writer;
  const MessageCapture errors(writer);
  writer->SetInputConnection(ball->GetOutputPort());
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), vtkErrorCode::NoFileNameError) << "without a name";
  writer->SetFileName((folder + "ball.vdb").c_str());
  writer->Write();
  EXPECT_EQ(writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError))
    << "with one";
}

}
