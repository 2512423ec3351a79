/* Command validate scene: a scene's facets against temperatures that were measured on them. */
#ifndef COMMAND_VALIDATE_SCENE_H
#define COMMAND_VALIDATE_SCENE_H

/* Runs `radsig validate thermal SCENE.toml FILE.csv`; returns the exit code. */
int command_validate_scene(int argc, char **argv);

#endif
