// Validates the sizes in the headers of an EXR file against the file size before OpenEXR allocates
// memory. The scan knows the layout of headers, not the meaning of most attributes.

#ifndef EXRHeaderScan_h
#define EXRHeaderScan_h

#include "EXR/EXRStreams.h"

namespace activesurface
{

// Throws a FileError, with a sentence, unless the stream begins with valid EXR headers. Windows,
// tiles, tables and attributes have to fit into a file of this size. Rewinds the stream.
void CheckEXRHeaders(EXRInput& input);

// Lines of a scan-line image that OpenEXR packs into one chunk, by the compression's number in the
// header.
int CountLinesOfChunk(unsigned compression);

// Returns true if the stream begins with the first bytes of an EXR file.
bool IsEXR(std::istream& stream);

}

#endif
