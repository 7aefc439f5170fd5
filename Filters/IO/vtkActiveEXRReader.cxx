#define VTK_DEPRECATION_LEVEL 0 // MemoryBuffer, which VTK 9.6 deprecates
#include "vtkActiveEXRReader.h"

#include "Base/ErrorText.h"
#include "Common/FileError.h"
#include "Common/FileSeries.h"
#include "EXR/EXRImage.h"

#include "vtkImageData.h"
#include "vtkImageReader2Factory.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <fstream>

using activesurface::EXRExtent;
using activesurface::EXRFile;
using activesurface::EXRPart;
using activesurface::FileError;

struct vtkActiveEXRReader::Series
{
  std::vector<std::string> Names;
  activesurface::FileTimes Times;
  EXRExtent Extent{};
  std::vector<EXRPart> Parts; // of the first file
  activesurface::EXRMemory Memory;
  activesurface::EXRSelection Selection;
};

vtkStandardNewMacro(vtkActiveEXRReader);

namespace
{

// Calls read(file) with an open file. Errors name the file.
template <class Read>
void WithFile(const std::string& name, const activesurface::EXRMemory& memory, const Read& read)
{
  try
  {
    EXRFile file(name, memory);
    read(file);
  }
  catch (const FileError& error)
  {
    throw FileError(error.GetCode(), "Cannot read \"" + name + "\": " + error.what() + ".");
  }
}

}

vtkActiveEXRReader::vtkActiveEXRReader()
  : Files(std::make_unique<Series>())
{
}

vtkActiveEXRReader::~vtkActiveEXRReader() = default;

void vtkActiveEXRReader::RegisterWithFactory()
{
  static const bool registered = []
  {
    vtkNew<vtkActiveEXRReader> reader;
    vtkImageReader2Factory::RegisterReader(reader);
    return true;
  }();
  static_cast<void>(registered);
}

const char* vtkActiveEXRReader::GetDescriptiveName()
{
  return "OpenEXR";
}

int vtkActiveEXRReader::CanReadFile(const char* name)
{
  constexpr char magic[4] = { 0x76, 0x2f, 0x31, 0x01 };
  char bytes[4] = {};
  std::ifstream stream(name ? name : "", std::ios::binary);
  return stream.read(bytes, 4) && std::equal(bytes, bytes + 4, magic) ? 3 : 0;
}

int vtkActiveEXRReader::GetNumberOfParts()
{
  return static_cast<int>(this->Files->Parts.size());
}

const char* vtkActiveEXRReader::GetPartName(int part)
{
  const bool found = part >= 0 && part < this->GetNumberOfParts();
  return found ? this->Files->Parts[part].Name.c_str() : nullptr;
}

const char* vtkActiveEXRReader::GetPartType(int part)
{
  const bool found = part >= 0 && part < this->GetNumberOfParts();
  return found ? this->Files->Parts[part].Type.c_str() : nullptr;
}

int vtkActiveEXRReader::GetNumberOfChannels()
{
  const bool found = this->Part < this->GetNumberOfParts();
  return found ? static_cast<int>(this->Files->Parts[this->Part].Channels.size()) : 0;
}

const char* vtkActiveEXRReader::GetChannelName(int index)
{
  const bool found = index >= 0 && index < this->GetNumberOfChannels();
  return found ? this->Files->Parts[this->Part].Channels[index].Name.c_str() : nullptr;
}

int vtkActiveEXRReader::GetChannelType(int index)
{
  const bool found = index >= 0 && index < this->GetNumberOfChannels();
  return found ? static_cast<int>(this->Files->Parts[this->Part].Channels[index].Type) : -1;
}

void vtkActiveEXRReader::EnableChannel(const char* name)
{
  if (name && !this->IsChannelEnabled(name))
  {
    activesurface::EXRSelection& selection = this->Files->Selection;
    selection.All ? static_cast<void>(selection.Exceptions.erase(name))
                  : static_cast<void>(selection.Exceptions.insert(name));
    this->Modified();
  }
}

void vtkActiveEXRReader::DisableChannel(const char* name)
{
  if (name && this->IsChannelEnabled(name))
  {
    activesurface::EXRSelection& selection = this->Files->Selection;
    selection.All ? static_cast<void>(selection.Exceptions.insert(name))
                  : static_cast<void>(selection.Exceptions.erase(name));
    this->Modified();
  }
}

void vtkActiveEXRReader::EnableAllChannels()
{
  this->Files->Selection = { true, {} };
  this->Modified();
}

void vtkActiveEXRReader::DisableAllChannels()
{
  this->Files->Selection = { false, {} };
  this->Modified();
}

bool vtkActiveEXRReader::IsChannelEnabled(const char* name)
{
  return name && this->Files->Selection.Has(name);
}

void vtkActiveEXRReader::AddFileName(const char* name)
{
  const vtkNew<vtkStringArray> names;
  if (this->FileNames)
  {
    names->DeepCopy(this->FileNames);
  }
  names->InsertNextValue(name ? name : "");
  this->SetFileNames(names);
}

void vtkActiveEXRReader::ClearFileNames()
{
  this->SetFileNames(nullptr);
}

void vtkActiveEXRReader::NameFiles()
{
  Series& files = *this->Files;
  files.Names.clear();
  files.Memory = { static_cast<const char*>(this->MemoryBuffer),
    static_cast<std::size_t>(std::max<vtkIdType>(this->MemoryBufferLength, 0)) };
  if (files.Memory.Bytes)
  {
    files.Names.emplace_back("(memory)");
    return;
  }
  const vtkIdType count = this->FileNames ? this->FileNames->GetNumberOfValues() : 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    files.Names.push_back(this->FileNames->GetValue(i));
  }
  if (count == 0 && this->FileName && *this->FileName)
  {
    files.Names.emplace_back(this->FileName);
  }
  if (files.Names.empty())
  {
    throw FileError(
      vtkErrorCode::NoFileNameError, "There is no file to read; set FileName or FileNames.");
  }
}

// Collects times and extent from the headers of all files, and the parts of the first file.
void vtkActiveEXRReader::ScanFiles()
{
  Series& files = *this->Files;
  files.Parts.clear();
  files.Times = {};
  std::vector<double> times;
  for (const std::string& name : files.Names)
  {
    WithFile(name, files.Memory,
      [&](const EXRFile& file)
      {
        if (files.Parts.empty())
        {
          files.Parts = file.GetParts();
        }
        const EXRPart& part = activesurface::FindEXRPart(file, this->Part);
        activesurface::FindEXRLayers(part, files.Selection); // throws if there are none
        const EXRExtent& extent = this->Window == DISPLAY ? part.Display : part.Data;
        files.Extent = times.empty() ? extent : activesurface::UniteExtents(files.Extent, extent);
        times.push_back(part.Time);
      });
  }
  files.Times = activesurface::FileTimes(std::move(times));
}

void vtkActiveEXRReader::Publish(vtkInformation* information)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const Series& files = *this->Files;
  const EXRExtent& extent = files.Extent;
  const int whole[6] = { extent[0], extent[1], extent[2], extent[3], 0, 0 };
  std::copy_n(whole, 6, this->DataExtent);
  information->Set(Pipeline::WHOLE_EXTENT(), whole, 6);
  information->Set(vtkDataObject::SPACING(), this->DataSpacing, 3);
  information->Set(vtkDataObject::ORIGIN(), this->DataOrigin, 3);
  const auto layers = activesurface::FindEXRLayers(files.Parts[this->Part], files.Selection);
  this->DataScalarType = layers.front().Integer ? VTK_UNSIGNED_INT : VTK_FLOAT;
  this->NumberOfScalarComponents = static_cast<int>(layers.front().Channels.size());
  vtkDataObject::SetPointDataActiveScalarInfo(
    information, this->DataScalarType, this->NumberOfScalarComponents);
  files.Times.Publish(information);
}

int vtkActiveEXRReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    this->NameFiles();
    this->ScanFiles();
    this->Publish(outputs->GetInformationObject(0));
    return 1;
  }
  catch (const std::exception& error)
  {
    return this->Fail(activesurface::GetErrorCode(error), activesurface::TextOf(error), outputs);
  }
}

namespace
{

// Crops the image to the requested extent, as a rank of a parallel program needs.
void CropToRequest(vtkInformation* information, vtkImageData* image)
{
  int* part = information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
  if (!part)
  {
    return;
  }
  if (part[0] > part[1] || part[2] > part[3] || part[4] > part[5])
  {
    image->Initialize();
    return;
  }
  image->Crop(part);
}

}

void vtkActiveEXRReader::ReadStep(vtkInformation* information)
{
  const Series& files = *this->Files;
  const int number = files.Times.FindFile(information);
  vtkImageData* output = vtkImageData::GetData(information);
  output->Initialize();
  output->SetSpacing(this->DataSpacing);
  output->SetOrigin(this->DataOrigin);
  constexpr double bytesPerMiB = 1 << 20;
  WithFile(files.Names[static_cast<std::size_t>(number)], files.Memory,
    [&](EXRFile& file)
    {
      activesurface::ReadEXRImage(file, static_cast<std::size_t>(this->Part), files.Selection,
        files.Extent, this->MaximumMemory * bytesPerMiB, output);
    });
  CropToRequest(information, output);
  files.Times.Mark(number, output);
}

int vtkActiveEXRReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    this->ReadStep(outputs->GetInformationObject(0));
    return 1;
  }
  catch (const std::exception& error)
  {
    return this->Fail(activesurface::GetErrorCode(error), activesurface::TextOf(error), outputs);
  }
}

// Reports an error and empties the output.
int vtkActiveEXRReader::Fail(
  unsigned long code, const std::string& sentence, vtkInformationVector* outputs)
{
  if (vtkImageData* output = vtkImageData::GetData(outputs))
  {
    output->Initialize();
  }
  this->SetErrorCode(code);
  vtkErrorMacro(<< sentence);
  return 0;
}

void vtkActiveEXRReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Part: " << this->Part << "\n";
  os << indent << "Window: " << (this->Window == DATA ? "data" : "display") << "\n";
  os << indent << "MaximumMemory: " << this->MaximumMemory << " MiB\n";
}
