// Serializes a piece of an input. Lossless: numbers keep their types and all bits.

#ifndef PieceBytes_h
#define PieceBytes_h

#include "Ranks/Communicator.h"

namespace activesurface
{

struct InputPiece;

// Throw std::runtime_error if a piece cannot be written or read.
Bytes PackPiece(const InputPiece& piece);
InputPiece UnpackPiece(const Bytes& bytes);

}

#endif
