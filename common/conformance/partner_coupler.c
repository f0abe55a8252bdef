/* The coupler of the conformance kit, without physics; scripts/conform.py runs it. */
#include "common/conformance/examine.h"

int main(int argc, char **argv)
{
  static Kit k;
  KitOpen(argc, argv, &k);
  if (k.of_fluid)
    ExamineFluid(&k);
  else
    ExamineSolid(&k);
  return KitClose(&k);
}
