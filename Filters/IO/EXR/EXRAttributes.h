// The attributes of an EXR header, to and from VTK.

#ifndef EXRAttributes_h
#define EXRAttributes_h

#include <ImfHeader.h>

#include <string>

class vtkFieldData;

namespace activesurface
{

// One array for each attribute that is a number, a text or a few of them, by the attribute's name;
// matrices row by row, as points are multiplied by them in VTK; time codes and enumerations as
// text.
void CopyEXRAttributes(const Imf::Header& header, vtkFieldData* data);

// Sets timeCode from "hh:mm:ss:ff". Throws FileError if it is none.
void AddTimeCode(Imf::Header& header, const std::string& text);

// Sets framesPerSecond; 24000/1001 and the like where it is one of those.
void AddFramesPerSecond(Imf::Header& header, double rate);

}

#endif
