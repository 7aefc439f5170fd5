// Converts the attributes of an EXR header to and from VTK.

#ifndef EXRAttributes_h
#define EXRAttributes_h

#include <ImfHeader.h>

#include <string>

class vtkFieldData;

namespace activesurface
{

// Adds an array for each attribute of a supported type: a number, a text, or a few of these. The
// array has the attribute's name. Matrices are stored row by row, transposed for VTK's column
// vectors. Time codes and the compression become texts.
void CopyEXRAttributes(const Imf::Header& header, vtkFieldData* data);

// Sets timeCode from "hours:minutes:seconds:frame". Throws FileError for other texts, and for
// numbers out of range.
void AddTimeCode(Imf::Header& header, const std::string& text);

}

#endif
