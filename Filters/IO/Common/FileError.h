// Failure to read or write a file: a message and the error code of VTK's readers and writers
// (vtkErrorCode).

#ifndef FileError_h
#define FileError_h

#include <stdexcept>
#include <string>

#include "vtkErrorCode.h"

namespace activesurface
{

class FileError : public std::runtime_error
{
public:
  FileError(unsigned long code, const std::string& sentence)
    : std::runtime_error(sentence)
    , Code(code)
  {
  }

  unsigned long GetCode() const { return this->Code; }

private:
  unsigned long Code;
};

// Returns the code of a FileError, or UnknownError for other exceptions.
inline unsigned long GetErrorCode(const std::exception& error)
{
  const auto* known = dynamic_cast<const FileError*>(&error);
  return known ? known->GetCode() : static_cast<unsigned long>(vtkErrorCode::UnknownError);
}

}

#endif
