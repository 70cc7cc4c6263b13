// rend: the program. See command.h for what it does.
#include "render/commands/command.h"

int main(int count, char** arguments) {
  return rend::run_program(count, arguments);
}
