#include "vtkActiveEXRWriter.h"

#include "Base/ErrorText.h"
#include "Common/FileError.h"
#include "Common/FileSeries.h"
#include "EXR/EXRWriting.h"

#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <vector>

using activesurface::FileError;

struct vtkActiveEXRWriter::Settings
{
  activesurface::EXRChoices Choices;
  activesurface::EXRHeaderSettings Header; // without the writer's own properties
  std::vector<double> Times;               // of the input
  int Step = 0;                            // index of the step that is being written
  bool Asked = false;                      // true after RequestData, so the input was updated
};

vtkStandardNewMacro(vtkActiveEXRWriter);

vtkActiveEXRWriter::vtkActiveEXRWriter()
  : Chosen(std::make_unique<Settings>())
{
  this->Chosen->Header.Texts["software"] = "Active Implicit Surfaces for VTK " ACTIVE_VERSION;
}

vtkActiveEXRWriter::~vtkActiveEXRWriter()
{
  this->SetTimeCode(nullptr);
}

void vtkActiveEXRWriter::SetWorldToCamera(vtkMatrix4x4* matrix)
{
  if (this->Chosen->Header.WorldToCamera != matrix)
  {
    this->Chosen->Header.WorldToCamera = matrix;
    this->Modified();
  }
}

void vtkActiveEXRWriter::SetWorldToNDC(vtkMatrix4x4* matrix)
{
  if (this->Chosen->Header.WorldToNDC != matrix)
  {
    this->Chosen->Header.WorldToNDC = matrix;
    this->Modified();
  }
}

vtkMatrix4x4* vtkActiveEXRWriter::GetWorldToCamera()
{
  return this->Chosen->Header.WorldToCamera;
}

vtkMatrix4x4* vtkActiveEXRWriter::GetWorldToNDC()
{
  return this->Chosen->Header.WorldToNDC;
}

void vtkActiveEXRWriter::AddAttribute(const char* name, const char* text)
{
  if (name && *name && text)
  {
    this->Chosen->Header.Numbers.erase(name);
    this->Chosen->Header.Texts[name] = text;
    this->Modified();
  }
}

void vtkActiveEXRWriter::AddAttribute(const char* name, double number)
{
  if (name && *name)
  {
    this->Chosen->Header.Texts.erase(name);
    this->Chosen->Header.Numbers[name] = number;
    this->Modified();
  }
}

void vtkActiveEXRWriter::ClearAttributes()
{
  this->Chosen->Header.Texts.clear();
  this->Chosen->Header.Numbers.clear();
  this->Modified();
}

void vtkActiveEXRWriter::AddChannel(const char* array, int component, const char* channel)
{
  this->Chosen->Choices.Channels.push_back(
    { array ? array : "", component, channel ? channel : "" });
  this->Modified();
}

void vtkActiveEXRWriter::ClearChannels()
{
  this->Chosen->Choices.Channels.clear();
  this->Modified();
}

void vtkActiveEXRWriter::AssignPixelType(const char* array, int type)
{
  if (!array || type < UINT || type > FLOAT)
  {
    vtkErrorMacro("AssignPixelType was called with the array "
      << (array ? array : "null") << " and the type " << type
      << "; it needs an array's name and a type, UINT (0), HALF (1) or FLOAT (2).");
    return;
  }
  this->Chosen->Choices.Types[array] = static_cast<activesurface::EXRPixel>(type);
  this->Modified();
}

void vtkActiveEXRWriter::ClearPixelTypes()
{
  this->Chosen->Choices.Types.clear();
  this->Modified();
}

void vtkActiveEXRWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (this->GetNumberOfInputConnections(0) == 0)
  {
    this->Fail(vtkErrorCode::UserError, "There is no input to write; connect an image.");
    return;
  }
  Settings& chosen = *this->Chosen;
  // Not by CONTINUE_EXECUTING: if the input fails at a later step, VTK repeats the update forever.
  for (chosen.Step = 0; chosen.Step == 0 || chosen.Step < this->CountSteps(); ++chosen.Step)
  {
    chosen.Asked = false;
    this->Modified(); // forces writing although nothing has changed
    // UpdateWholeExtent continues with the last output of an input that fails here.
    if (this->GetExecutive()->UpdateInformation())
    {
      this->UpdateWholeExtent();
    }
    if (!chosen.Asked)
    {
      this->Fail(vtkErrorCode::UnknownError,
        "The update of the input failed, so no file is written for this time; see the error of "
        "the input.");
    }
    if (this->GetErrorCode() != vtkErrorCode::NoError)
    {
      break;
    }
  }
  chosen.Step = 0;
}

int vtkActiveEXRWriter::CountSteps() const
{
  return this->WriteAllTimeSteps ? static_cast<int>(this->Chosen->Times.size()) : 1;
}

int vtkActiveEXRWriter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  vtkInformation* information = inputs[0]->GetInformationObject(0);
  const auto key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  this->Chosen->Times.clear();
  if (information->Has(key))
  {
    const double* times = information->Get(key);
    this->Chosen->Times.assign(times, times + information->Length(key));
  }
  return 1;
}

int vtkActiveEXRWriter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  const Settings& chosen = *this->Chosen;
  if (this->WriteAllTimeSteps && !chosen.Times.empty())
  {
    inputs[0]->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(),
      chosen.Times[static_cast<std::size_t>(chosen.Step)]);
  }
  return 1;
}

int vtkActiveEXRWriter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  this->Chosen->Asked = true;
  this->WriteStep(vtkImageData::GetData(inputs[0]));
  return this->GetErrorCode() == vtkErrorCode::NoError ? 1 : 0;
}

void vtkActiveEXRWriter::WriteStep(vtkImageData* image)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  std::string name = this->FileName ? this->FileName : "";
  if (name.empty())
  {
    this->Fail(
      vtkErrorCode::NoFileNameError, "FileName is not set; set it to the .exr file to write.");
    return;
  }
  try
  {
    const int number = this->FrameNumber + this->Chosen->Step;
    name = activesurface::MakeFrameName(name, number, this->WriteAllTimeSteps);
    this->WriteImage(image, name);
  }
  catch (const std::exception& error)
  {
    this->Fail(activesurface::GetErrorCode(error),
      "Cannot write \"" + name + "\": " + activesurface::TextOf(error));
  }
}

namespace
{

void CheckSize(vtkImageData* image, const int displaySize[2])
{
  constexpr int largest = 1 << 24;
  if (!image || image->GetNumberOfPoints() == 0)
  {
    throw FileError(vtkErrorCode::UserError, "the input is empty.");
  }
  const int* dimensions = image->GetDimensions();
  if (dimensions[2] != 1)
  {
    throw FileError(vtkErrorCode::UserError,
      "the input has " + std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) +
        " x " + std::to_string(dimensions[2]) +
        " points, but only a slice of one point along z can be written; extract such a slice by "
        "vtkExtractVOI, or turn a slice of one point along x or y by vtkImagePermute.");
  }
  const int width = displaySize[0], height = displaySize[1];
  const bool none = width == 0 && height == 0;
  if (!none && (width < 1 || height < 1 || width > largest || height > largest))
  {
    throw FileError(vtkErrorCode::UserError,
      "DisplaySize is (" + std::to_string(width) + ", " + std::to_string(height) +
        "), but has to be (0, 0), the image's size, or two numbers from 1 to 16777216.");
  }
}

}

void vtkActiveEXRWriter::WriteImage(vtkImageData* image, const std::string& name)
{
  CheckSize(image, this->DisplaySize);
  const Settings& chosen = *this->Chosen;
  activesurface::EXRHeaderSettings header = chosen.Header;
  header.Compression = this->Compression;
  header.Level = this->CompressionLevel;
  std::copy_n(image->GetExtent(), 4, header.Extent.begin());
  std::copy_n(this->DisplaySize, 2, header.DisplaySize.begin());
  header.PixelAspectRatio = this->PixelAspectRatio;
  header.FramesPerSecond = this->FramesPerSecond;
  header.TimeCode = this->TimeCode ? this->TimeCode : "";
  vtkInformation* information = image->GetInformation();
  if (information->Has(vtkDataObject::DATA_TIME_STEP()))
  {
    header.Numbers.emplace("time", information->Get(vtkDataObject::DATA_TIME_STEP()));
  }
  activesurface::EXRChoices choices = chosen.Choices;
  choices.FromSRGB = this->ColorEncoding == SRGB;
  activesurface::WriteEXR(name, header, activesurface::PlanChannels(image, choices));
}

void vtkActiveEXRWriter::Fail(unsigned long code, const std::string& sentence)
{
  this->SetErrorCode(code);
  vtkErrorMacro(<< sentence << (sentence.back() == '.' ? "" : "."));
}

void vtkActiveEXRWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  static const char* const names[] = { "none", "ZIP", "ZIPS", "PIZ", "DWAA" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Compression: " << names[this->Compression] << "\n";
  os << indent << "CompressionLevel: " << this->CompressionLevel << "\n";
  os << indent << "ColorEncoding: " << (this->ColorEncoding == SRGB ? "sRGB" : "linear") << "\n";
  os << indent << "DisplaySize: " << this->DisplaySize[0] << ", " << this->DisplaySize[1] << "\n";
  os << indent << "PixelAspectRatio: " << this->PixelAspectRatio << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
  os << indent << "WorldToCamera: " << this->GetWorldToCamera() << "\n";
  os << indent << "WorldToNDC: " << this->GetWorldToNDC() << "\n";
  os << indent << "TimeCode: " << (this->TimeCode ? this->TimeCode : "(none)") << "\n";
  os << indent << "WriteAllTimeSteps: " << (this->WriteAllTimeSteps ? "on" : "off") << "\n";
  os << indent << "FrameNumber: " << this->FrameNumber << "\n";
}
