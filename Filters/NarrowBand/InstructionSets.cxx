#include "InstructionSets.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace activesurface
{

namespace
{

InstructionSet FindBest()
{
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_cpu_init();
  const bool hasBits = __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
    __builtin_cpu_supports("popcnt");
  const bool hasAvx2 = hasBits && __builtin_cpu_supports("avx2");
  if (hasAvx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
  {
    return InstructionSet::Avx512;
  }
  if (hasAvx2)
  {
    return InstructionSet::Avx2;
  }
#endif
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
