// An older three, installed beside the newer one under this name.
process.argv[3] = "three-0160";
require("./three.cjs");
