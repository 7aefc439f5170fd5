// Arbitrary bytes as an .exr file.

#include "FuzzInput.h"

#include "vtkActiveEXRReader.h"

#include <vtkNew.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<vtkActiveEXRReader> reader;
  reader->SetMaximumMemory(16);
  reader->SetMemoryBuffer(data);
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(size));
  reader->UpdateInformation();
  for (int part = 0; part < reader->GetNumberOfParts() && part < 3; ++part)
  {
    reader->SetPart(part);
    reader->Update();
  }
  return 0;
}
