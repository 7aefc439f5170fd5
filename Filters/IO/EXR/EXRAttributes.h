// Converts the attributes of an EXR header to and from VTK.

#ifndef EXRAttributes_h
#define EXRAttributes_h

#include <ImfHeader.h>

#include <string>

class vtkFieldData;

namespace activesurface
{

// Adds an array, named after the attribute, for each attribute of one or a few numbers or texts.
// Matrices are stored row by row, transposed for VTK's column vectors. Time codes and enumerations
// become texts.
void CopyEXRAttributes(const Imf::Header& header, vtkFieldData* data);

// Sets timeCode from "hh:mm:ss:ff". Throws FileError if the text has another form.
void AddTimeCode(Imf::Header& header, const std::string& text);

}

#endif
