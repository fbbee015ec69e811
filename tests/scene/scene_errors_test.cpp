// Tests that the error for a bad scene is one line that names the file, the line number, the key and the
// permitted values.
#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const std::vector<test::Bad> bad_scenes = {
    {"fur.lenght = 0.1", "s.toml:1: fur.lenght: no such key; did you mean fur.length?"},
    {"\n\nlength = 0.1", "s.toml:3: length: no such key; did you mean fur.length?"},
    {"[furr]\nlength = 0.1", "s.toml:1: furr"},
    {"zzzzzzzzzzzz = 1", "no such key; `pelage scene` prints all keys"},
    {"[fur]\nlayers = 1", "s.toml:2: fur.layers: 1 is out of range; give 2 to 512"},
    {"fur.layers = 0", "fur.layers: 0 is out of range"},
    {"fur.layers = -16", "fur.layers: -16 is out of range"},
    {"fur.layers = 16.0", "fur.layers: is a number; give 2 to 512"},
    {"fur.layers = 99999999999", "fur.layers: 99999999999 is out of range"},
    {"fur.layers = \"16\"", "fur.layers: is a string; give 2 to 512"},
    {"fur.layers = true", "fur.layers: is a truth value; give 2 to 512"},
    {"fur.layers = [16]", "fur.layers: is an array; give 2 to 512"},
    {"fur.layers = 2026-01-01", "fur.layers: is a date or time; give 2 to 512"},
    {"fur.layers = {n = 16}", "fur.layers: is a table; give 2 to 512"},
    {"fur.length = nan", "fur.length: nan is not a finite number; give 0.001 to 1 R"},
    {"fur.length = inf", "fur.length: inf is not a finite number"},
    {"fur.length = -inf", "fur.length: -inf is not a finite number"},
    {"fur.length = 1e300", "fur.length: 1e+300 is out of range"},
    {"fur.length = 0", "fur.length: 0 is out of range"},
    {"fur.texture = 100", "fur.texture: 100 is not a power of two"},
    {"fur.texture = 1024\nfur.layers = 512", "fur.layers: 512 layers of 1024 x 1024 texels"},
    {"fur.strands = 0\nfur.undercoat = 0", "neither guard hairs nor undercoat"},
    {"fur.seed = -1", "fur.seed: -1 is out of range; give 0 to 4294967295"},
    {"soaked.threshold = 0.5\nshading.model = \"curling\"",
     "soaked.threshold = 0.5 needs shading.model = \"wet\""},
    {"fur.binding = \"both\"", "fur.binding: \"both\" is not known; give \"shared\" or \"separate\""},
    {"coat.pattern = 'dots'", "give \"plain\", \"patches\", \"stripes\", \"spots\" or \"grass\""},
    {"fur.comb_direction = [0, 0, 0]", "fur.comb_direction: points nowhere; give a direction"},
    {"fur.comb_direction = [1, 2]", "fur.comb_direction: has 2 entries; give a direction [x, y, z]"},
    {"coat.colour = 'red'", "coat.colour: is a string; give three numbers, each 0 to 1 RGB"},
    {"coat.colour = [1, 'red', 0]", "coat.colour: is a string"},
    {"coat.colour = [1, 0.5, 1.5]", "coat.colour: 1.5 is out of range"},
    {"coat.image = 3", "coat.image: is a whole number; give a path"},
    {"model = 3", "model: is a whole number; give a string"},
    {"model = ''", "model: is empty"},
    {"fur = 3", "fur: is a whole number; give a TOML table [fur] with keys"},
    {"dynamics.wind = 3", "dynamics.wind: is a whole number; give a TOML table [dynamics.wind] with keys"},
    {"camera.framed = 1", "camera.framed: is a whole number; give true or false"},
    {"camera.framed = false\ncamera.eye = [0, 0, 0]", "camera.eye: equals camera.target"},
    {"camera.up = [1.3, 1.15, 2.35]", "camera.up: is parallel to the view"},
    {"wetness.rate = -1", "wetness.rate: -1 is out of range; give 0 to 1000000 droplets/s"},
    {"wetness.soak = -0.5", "wetness.soak: -0.5 is out of range; give 0 to 3600 s"},
    {"wetness.drying = nan", "wetness.drying: nan is not a finite number; give 0 to 3600 s"},
    {"wetness.drip = 'fast'", "wetness.drip: is a string; give 0 to 1000 1/s"},
    {"wetness.begin = 5\nwetness.end = 4",
     "wetness.end: 4 s is before wetness.begin (5 s); give 5 s or more"},
    {"wetness.rate = 10", "wetness.rate: there are no random droplets that can arrive; give wetness.random"},
    {"[[wetness.droplet]]\nuv = [0, 0]\ntime = -1",
     "wetness.droplet[1].time: -1 is out of range; give 0 to 3600 s"},
    {"fur.density = 1.5", "fur.density: 1.5 is out of range; give 0 to 1"},
    {"fur.length_map = 1", "fur.length_map: is a whole number; give a path"},
    {"fur.length_map = 'a.png'\ndynamics.topology = 'sticks'", "fur.length_map: not supported by"},
    {"[[contact.sphere]]\nradius = 0", "contact.sphere[1].radius: 0 is out of range; give 0.001 to 100 R"},
    {"[[contact.sphere]]\nradius = -1", "contact.sphere[1].radius: -1 is out of range"},
    {"[[contact.sphere]]\ncentre = [0, nan, 0]", "contact.sphere[1].centre: nan is not a finite number"},
    {"[[contact.sphere]]\nbegin = 2\nend = 1", "contact.sphere[1].end: 1 s is not after the beginning, 2 s"},
    {"[[contact.capsule]]\nradius = 0", "contact.capsule[1].radius: 0 is out of range"},
    {"[[contact.capsule]]\nbegin = 1\nend = 1", "contact.capsule[1].end: 1 s is not after the beginning"},
    {"contact.mesh_begin = 5\ncontact.mesh_end = 4", "contact.mesh_end: 4 s is not after the beginning"},
    {"contact.mesh_spin = 1001", "contact.mesh_spin: 1001 is out of range; give -1000 to 1000 rad/s"},
    {"contact.mesh_axis = [0, 0, 0]", "contact.mesh_axis: points nowhere"},
    {"contact.mesh_frames = 0", "contact.mesh_frames: 0 is out of range; give 1 to 10000"},
    {"contact.mesh_after_frames = 'stop'", "contact.mesh_after_frames: \"stop\" is not known"},
    {"contact.mesh_spin = 1", "contact.mesh_spin: there is no mesh; give contact.mesh"},
    {"contact.mesh_frames = 2", "contact.mesh_frames: there is no mesh; give contact.mesh"},
    {"contact.mesh_cells = 3", "contact.mesh_cells: 3 is out of range; give 4 to 256"},
    {"[[contact.sphere]]\n[dynamics]\ntopology = 'prisms'\ntolerance = 0.01", "give dynamics.tolerance = 0"},
    {"[[contact.sphere]]\n[dynamics]\ntopology = 'sticks'\nmotion.spin = 1", "leave out dynamics.motion"},
    {"[[contact.sphere]]\n[dynamics]\ntopology = 'sticks'\nsolver = 'wind-vectors'",
     "contact: colliders do not push the sticks of the solver wind-vectors"},
    {"[contact]\nsphere = [{}, {}, {}, {}, {}]\ncapsule = [{}, {}, {}, {}]",
     "contact.capsule: 9 spheres and capsules; give at most 8 together"},
    {"dynamics.step = 0", "dynamics.step: 0 is out of range"},
    {"dynamics.step = 0.5", "dynamics.step: 0.5 s is unstable"},
    {"dynamics.topology = 'grass'",
     "dynamics.topology: \"grass\" is not known; give \"silva\", \"chains\", \"sticks\""},
    {"dynamics.topology = 'sticks'\nfur.binding = 'separate'",
     "fur.binding: must be \"shared\" if dynamics.topology is \"sticks\""},
    {"dynamics.topology = 'prisms'\ndynamics.drag = 0\ndynamics.wind.strength = 0.01",
     "dynamics.wind.strength: with a mass-spring topology, the wind has no effect without drag"},
    {"dynamics.topology = 'sticks'\ndynamics.step = 0", "dynamics.step: 0 is out of range"},
    {"dynamics.topology = 'sticks'\ndynamics.mass = -1", "dynamics.mass: -1 is out of range"},
    {"dynamics.topology = 'sticks'\ndynamics.springs.stiffness = -1",
     "dynamics.springs.stiffness: -1 is out of range"},
    {"dynamics.springs.return_weight = nan", "dynamics.springs.return_weight: nan is not a finite number"},
    {"dynamics.bend = 'cubic'", "give \"linear\", \"paper\", \"tangent\" or \"trigonometric\""},
    {"dynamics.bend_power = 0", "dynamics.bend_power: 0 is out of range; give 1 to 16"},
    {"dynamics.solver = 'rk4'",
     "dynamics.solver: not supported by dynamics.topology \"silva\"; give another topology"},
    {"dynamics.motion.spin = 1", "dynamics.motion.spin: not supported by dynamics.topology \"silva\""},
    {"dynamics.motion.axis = [0, 0, 0]", "dynamics.motion.axis: points nowhere"},
    {"dynamics.tolerance = 0.1", "dynamics.tolerance: not supported by dynamics.topology \"silva\""},
    {"dynamics.poke.radius = 1", "dynamics.poke.radius: not supported by dynamics.topology \"silva\""},
    {"dynamics.poke.ray = [1, 0, 0]", "dynamics.poke.ray: not supported by dynamics.topology \"silva\""},
    {"dynamics.springs = 3",
     "dynamics.springs: is a whole number; give a TOML table [dynamics.springs] with keys"},
    {"dynamics.time = 3600\ndynamics.step = 0.000001", "dynamics.time: 3600 s are "},
    {"image.width = 16385", "image.width: 16385 is out of range"},
    {"image = {width = 16384, height = 16384}", "268435456 pixels; give at most"},
    {"wetness.droplet = 3", "wetness.droplet: is a whole number; give [[wetness.droplet]] entries"},
    {"wetness.droplet = [3]", "wetness.droplet[1]: is a whole number"},
    {"[[wetness.droplet]]\nradius = 0.1",
     "wetness.droplet[1]: gives none of the keys uv and point; give exactly one"},
    {"[[wetness.droplet]]\nuv = [0, 0]\npoint = [0, 0, 1]",
     "wetness.droplet[1]: gives both of the keys uv and point"},
    {"[[wetness.droplet]]\nuv = [0, 0]\n[[wetness.droplet]]\nuv = [0, 0]\nradius = 0",
     "s.toml:5: wetness.droplet[2].radius: 0 is out"},
    {"[[wetness.droplet]]\nuv = [0, 0]\nwettness = 1",
     "wetness.droplet[1].wettness: no such key; did you mean wetness?"},
    {"[[shading.light]]\nintensity = nan", "shading.light[1].intensity: nan is not a finite number"},
    {"[[shading.light]]\n[[shading.light]]\n[[shading.light]]", "shading.light: 3 lights; give 1 to 2"},
    {"shading.light = []", "shading.light: 0 lights; give 1 to 2"},
    {"shading.wet_specular = 1", "shading.wet_specular: 1 is out of range"},
    {"fur.length = ", "s.toml:1: not TOML"},
    {"fur.length = 0.1\nfur.length = 0.2", "s.toml:2: not TOML"},
    {"[fur\nlength = 1", "s.toml:1: not TOML"},
    {"model = \"\xff\xfe\"", "s.toml:1: not TOML"},
    {"\xff\xfem", "s.toml: UTF-16 text, which is not read; save the file as UTF-8"},
    {"\n\xc4\x96.", "s.toml:2: not TOML: a character outside quotes is not ASCII"},
    {"fur.l\xc3\xa4nge = 1", "s.toml:1: not TOML: a character outside quotes is not ASCII"},
    {"model = \"\"\"a\\  \n \n \xc3\xa9\"\"\"",
     "s.toml:1: not TOML that pelage reads: in a string, the first"},
    {"fur.layers = 4\nmodel = \"\\\xc3\xa9\"",
     "s.toml:2: not TOML that pelage reads: in a string, the first"},
    {"fur.layers = 26[.\"\xef\xbb\x92\"",
     "s.toml:1: not TOML: the character [ must not follow another value"},
    {"fur.layers = 1.\"\xef\xbb\x92\"", "s.toml:1: not TOML: a string must not follow another value"},
    {"fur.layers = 1=\"\xef\xbb\x92\"", "s.toml:1: not TOML: a value contains the character ="},
    {"model = 'cow' \xe2\x80\xa8", "s.toml:1: not TOML: a character outside quotes is not ASCII"},
};

TEST(SceneErrors, EveryBadFileGetsOneLineThatSaysWhatIsRight) {
  test::expect_refusals(
      bad_scenes, [](const std::string& text) { parse_scene(text, "s.toml"); }, "s.toml");
}

const std::vector<test::Bad> overrides = {
    {"fur.length", "give key=value"},
    {"=3", "give key=value"},
    {"", "give key=value"},
    {"fur.lenght=3", "--set: fur.lenght: no such key; did you mean fur.length?"},
    {"fur=3", "--set: fur: no such key"},
    {"fur.length=abc", "'abc' is no TOML value; give 0.001 to 1 R"},
    {"fur.length=", "'' is no TOML value"},
    {"fur.length=nan", "nan is not a finite number"},
    {"fur.length=7", "7 is out of range"},
    {"fur.length=0.1\nfur.layers=2", "give one value"},
    {"fur.binding=none", "\"none\" is not known"},
    {"shading.model=\"dry", "no TOML value"},
    {"shading.light=3", "give [[shading.light]] entries"},
    {"shading.light=[{direction=[0,0,0]}]", "points nowhere"},
};

TEST(SceneErrors, EveryBadOverrideIsRefused) {
  test::expect_refusals(overrides, [](const std::string& text) {
    Scene scene;
    apply_set(scene, text);
  });
}

TEST(SceneErrors, ATopologyTakesWhatSilvasStrandDoesNot) {
  const Scene scene = parse_scene(
      "dynamics.topology = 'separable-prisms'\ndynamics.solver = 'backward-euler'\ndynamics.motion.spin = 2\n"
      "dynamics.poke.radius = 0.3\ndynamics.stiffness = 1e6\ndynamics.springs.stiffness = 0",
      "s.toml");
  EXPECT_TRUE(has_springs(scene.dynamics));
  EXPECT_TRUE(parts(scene));
  EXPECT_FALSE(parts(parse_scene("dynamics.topology = 'prisms'", "s.toml")));
  EXPECT_FALSE(parts(Scene{}));
}

TEST(SceneErrors, AbsurdFilesAreRefusedQuickly) {
  EXPECT_THROW(parse_scene(std::string(100000, '['), "deep"), InputError);
  EXPECT_THROW(parse_scene("a" + std::string(100000, 'b') + " = 1", "long"), InputError);
  EXPECT_NO_THROW(parse_scene("\xef\xbb\xbfmodel = '\xc3\xa4' # \xc3\xa4\n", "quoted"));
  // Dots in comments and strings do not separate parts of a key.
  const std::string sentence(2000, '.');
  EXPECT_NO_THROW(parse_scene("model = 'cow' # " + sentence, "comment"));
  EXPECT_NO_THROW(parse_scene("model = 'a" + sentence + "'", "string"));
  EXPECT_THROW(parse_scene(std::string("model = 'a'\0", 12), "nul"), InputError);
  EXPECT_THROW(read_scene("/nonexistent/scene.toml"), InputError);
  EXPECT_THROW(read_scene("/dev/zero"), InputError);
  EXPECT_THROW(read_scene("/"), InputError);
}

// toml++ crashes on keys of several hundred thousand parts, so pelage must refuse such keys.
TEST(SceneErrors, DeepKeysAreRefusedWhereverTheyStand) {
  std::string dotted = "a";
  for (int i = 1; i < 400'000; ++i) dotted += ".a";
  const std::string table = "{" + dotted + " = 1}";
  const std::string expected = "the key has 400000 parts separated by dots; the limit is 32";
  Scene scene;
  for (const std::string& value : {table, "[1,\n" + table + "]", "['''a'''', " + table + "]",
                                   "[\"'\", " + table + "]", "[\"\"\"\n.\"\"\", " + table + "]"}) {
    test::expect_has(test::refusal([&] { parse_scene("fur = " + value, "s"); }), expected);
    test::expect_has(test::refusal([&] { apply_set(scene, "shading.light = " + value); }), expected);
  }
  std::string nested;
  for (int i = 0; i < 200; ++i) nested += "{a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = ";
  nested += "1" + std::string(200, '}');
  test::expect_has(test::refusal([&] { parse_scene("fur = " + nested, "s"); }),
                   "the key and the keys that enclose it have 81 parts separated by dots; the limit is 64");
}

TEST(SceneErrors, ASceneMadeInCodeIsCheckedToo) {
  Scene scene;
  scene.fur.layers = 1;
  EXPECT_THROW(check_scene(scene), InputError);
  scene = {};
  scene.shading.lights[1].direction = glm::vec3(0);
  EXPECT_THROW(check_scene(scene), InputError);
  scene = {};
  scene.coat.pattern = "none";
  EXPECT_THROW(check_scene(scene), InputError);
}

}  // namespace
}  // namespace pelage
