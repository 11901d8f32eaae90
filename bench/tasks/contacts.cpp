// All triangle pairs that touch, pose by pose along the path.
#include "contacts.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {contactsTask("contacts")});
}
