#include "Base/InstructionSets.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace activesurface
{

namespace
{

InstructionSet FindBest()
{
  if (HasAvx512())
  {
    return InstructionSet::Avx512;
  }
  if (HasAvx2())
  {
    return InstructionSet::Avx2;
  }
  return InstructionSet::Baseline;
}

InstructionSet FindWanted()
{
  const char* variable = std::getenv("ACTIVE_INSTRUCTION_SET");
  const std::string name = variable ? variable : "";
  const InstructionSet wanted = name == "sse2" ? InstructionSet::Baseline
    : name == "avx2"                           ? InstructionSet::Avx2
                                               : InstructionSet::Avx512;
  return std::min(wanted, FindBest());
}

InstructionSet& Chosen()
{
  static InstructionSet chosen = FindWanted();
  return chosen;
}

}

InstructionSet GetInstructionSet()
{
  return Chosen();
}

InstructionSet SetInstructionSet(InstructionSet wanted)
{
  Chosen() = std::min(wanted, FindBest());
  return Chosen();
}

}
