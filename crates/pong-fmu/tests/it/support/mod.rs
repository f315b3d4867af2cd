//! Helpers of the tests: an FMU of a scene, unpacked, and the functions of FMI 3.0 as an importer calls them.

#![allow(non_snake_case, reason = "the standard names them")]

use flate2::read::DeflateDecoder;
use pong_fmu::{Fmi, LIBRARY_FILE, Options, Package};
use std::collections::BTreeMap;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::io::Read;
use std::path::{Path, PathBuf};

pub type Files = BTreeMap<String, Vec<u8>>;

/// The library that was built with this test.
pub fn library() -> Vec<u8> {
    let test = std::env::current_exe().unwrap();
    std::fs::read(test.with_file_name(LIBRARY_FILE)).unwrap()
}

/// A rough ball that falls, rotating, onto a ground, beside a swinging arm; `extra` is inserted among the
/// fields.
pub fn write_scene(folder: &Path, extra: &str) -> PathBuf {
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    let model = |name: &str, surface: &str, primitive: &str| {
        format!(
            r#"(format: "pong-model", version: 1, name: "{name}",
                surfaces: {{ "skin": ({surface}, normal: Linear(damping: 20.0), friction: Bristle(mu: 0.5, damping: 5.0)) }},
                root: (name: "{name}", surface: "skin", primitives: [{primitive}]))"#
        )
    };
    let ball = model("ball", "stiffness: 1e5", r#"Sphere(name: "s", center: (0, 0, 0), radius: 0.1)"#);
    let ground = model("ground", "stiffness: inf", r#"Plane(name: "p", normal: (0, 0, 1), offset: 0)"#);
    let tile =
        model("tile", "stiffness: 1e5", r#"TriangleMesh(name: "t", file: "tile.obj", thickness: 0.05)"#);
    let obj = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";
    let scene = format!(
        r#"(format: "pong-scene", version: 1, name: "drop of \"2\" <balls>",
            models: {{ "ball": "ball.ron", "ground": "ground.ron", "tile": "parts/tile.ron" }},
            objects: [
                (name: "my ball", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 5e-3, 6e-3),
                    mass_center: (0.01, 0.0, 0.02), position: (0.0, 0.0, 0.1001), angular_velocity: (3.0, 8.0, 1.0))]),
                (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
                (name: "arm", model: "tile", bodies: [(motion: Prescribed(Sinusoid(axis: (0.0, 0.0, 1.0), travel: 0.01,
                    frequency: 2.0)), position: (0.0, 0.0, 0.5))]),
            ],
            pairs: [("my ball", "ground"), ("my ball", "arm")],
            gravity: (0.0, 0.0, -9.81), integrator: RungeKutta4, step: 1e-4, duration: 0.1, {extra})"#
    );
    for (name, text) in
        [("ball.ron", &ball), ("ground.ron", &ground), ("parts/tile.ron", &tile), ("scene.ron", &scene)]
    {
        std::fs::write(folder.join(name), text).unwrap();
    }
    std::fs::write(folder.join("parts/tile.obj"), obj).unwrap();
    folder.join("scene.ron")
}

pub fn make(scene: &Path, fmi: Fmi, options: &Options) -> Package {
    pong_fmu::package(scene, &library(), fmi, options).unwrap_or_else(|error| panic!("{error}"))
}

/// The files of a ZIP file, by its central directory.
pub fn unzip(bytes: &[u8]) -> Files {
    let half = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let end = bytes.len() - 22;
    assert_eq!(word(end), 0x0605_4b50);
    let (count, mut at) = (half(end + 10), word(end + 16) as usize);
    let mut files = Files::new();
    for _ in 0..count {
        assert_eq!(word(at), 0x0201_4b50);
        let (crc, packed, length) = (word(at + 16), word(at + 20) as usize, word(at + 24) as usize);
        let (name, local) = (half(at + 28), word(at + 42) as usize);
        let text = String::from_utf8(bytes[at + 46..at + 46 + name].to_vec()).unwrap();
        assert_eq!(word(local), 0x0403_4b50);
        let from = local + 30 + half(local + 26) + half(local + 28);
        let mut content = Vec::new();
        DeflateDecoder::new(&bytes[from..from + packed]).read_to_end(&mut content).unwrap();
        let mut sum = flate2::Crc::new();
        sum.update(&content);
        assert_eq!((sum.sum(), content.len()), (crc, length), "{text}");
        assert!(files.insert(text, content).is_none());
        at += 46 + name;
    }
    files
}

/// An FMU, unpacked.
pub struct Unpacked {
    pub resources: PathBuf,
    pub token: String,
    /// Value references by name.
    pub references: BTreeMap<String, u32>,
}

pub fn unpack(package: &Package, folder: &Path) -> Unpacked {
    let files = unzip(&package.bytes);
    for (name, content) in &files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }
    let xml = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
    let attribute = |text: &str, name: &str| {
        let from = text.find(&format!(" {name}=\"")).map(|at| at + name.len() + 3)?;
        Some(text[from..from + text[from..].find('"')?].to_owned())
    };
    let token = attribute(&xml, "instantiationToken").or_else(|| attribute(&xml, "guid")).unwrap();
    let variables = xml.lines().filter(|line| line.contains("causality="));
    let references = variables.map(|line| {
        (attribute(line, "name").unwrap(), attribute(line, "valueReference").unwrap().parse().unwrap())
    });
    Unpacked { resources: folder.join("resources"), token, references: references.collect() }
}

pub const OK: c_int = 0;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

type Log = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

// Functions that an importer loads from the library; here they are linked in.
unsafe extern "C" {
    fn fmi3InstantiateModelExchange(
        name: *const c_char,
        token: *const c_char,
        resources: *const c_char,
        visible: bool,
        logging_on: bool,
        environment: *mut c_void,
        log: Option<Log>,
    ) -> *mut c_void;
    fn fmi3InstantiateCoSimulation(
        name: *const c_char,
        token: *const c_char,
        resources: *const c_char,
        visible: bool,
        logging_on: bool,
        event_mode_used: bool,
        early_return_allowed: bool,
        required: *const u32,
        required_count: usize,
        environment: *mut c_void,
        log: Option<Log>,
        update: *const c_void,
    ) -> *mut c_void;
    fn fmi3FreeInstance(component: *mut c_void);
    fn fmi3EnterInitializationMode(
        c: *mut c_void,
        has_tol: bool,
        tol: f64,
        start: f64,
        has_stop: bool,
        stop: f64,
    ) -> c_int;
    fn fmi3ExitInitializationMode(c: *mut c_void) -> c_int;
    fn fmi3Reset(c: *mut c_void) -> c_int;
    fn fmi3Terminate(c: *mut c_void) -> c_int;
    fn fmi3GetFloat64(c: *mut c_void, r: *const u32, n: usize, v: *mut f64, m: usize) -> c_int;
    fn fmi3GetBoolean(c: *mut c_void, r: *const u32, n: usize, v: *mut bool, m: usize) -> c_int;
    fn fmi3SetFloat64(c: *mut c_void, r: *const u32, n: usize, v: *const f64, m: usize) -> c_int;
    fn fmi3GetInt32(c: *mut c_void, r: *const u32, n: usize, v: *mut i32, m: usize) -> c_int;
    fn fmi3GetFMUState(c: *mut c_void, state: *mut *mut c_void) -> c_int;
    fn fmi3SetFMUState(c: *mut c_void, state: *mut c_void) -> c_int;
    fn fmi3FreeFMUState(c: *mut c_void, state: *mut *mut c_void) -> c_int;
    fn fmi3SerializedFMUStateSize(c: *mut c_void, state: *mut c_void, size: *mut usize) -> c_int;
    fn fmi3SerializeFMUState(c: *mut c_void, state: *mut c_void, bytes: *mut u8, size: usize) -> c_int;
    fn fmi3DeserializeFMUState(
        c: *mut c_void,
        bytes: *const u8,
        size: usize,
        state: *mut *mut c_void,
    ) -> c_int;
    fn fmi3DoStep(
        c: *mut c_void,
        from: f64,
        length: f64,
        never_back: bool,
        event: *mut bool,
        terminate: *mut bool,
        early: *mut bool,
        last: *mut f64,
    ) -> c_int;
    fn fmi3UpdateDiscreteStates(
        c: *mut c_void,
        needs_update: *mut bool,
        terminate: *mut bool,
        nominals: *mut bool,
        values: *mut bool,
        has_next: *mut bool,
        next: *mut f64,
    ) -> c_int;
    fn fmi3EnterContinuousTimeMode(c: *mut c_void) -> c_int;
    fn fmi3EnterEventMode(c: *mut c_void) -> c_int;
    fn fmi3SetTime(c: *mut c_void, time: f64) -> c_int;
    fn fmi3SetContinuousStates(c: *mut c_void, x: *const f64, n: usize) -> c_int;
    fn fmi3GetContinuousStates(c: *mut c_void, x: *mut f64, n: usize) -> c_int;
    fn fmi3GetContinuousStateDerivatives(c: *mut c_void, dx: *mut f64, n: usize) -> c_int;
    fn fmi3CompletedIntegratorStep(
        c: *mut c_void,
        never_back: bool,
        event: *mut bool,
        terminate: *mut bool,
    ) -> c_int;
}

/// Logger callback; the environment is the list of all messages.
unsafe extern "C" fn log(
    environment: *mut c_void,
    status: c_int,
    _category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the list with which the instance was made; a text that ends with a zero byte.
    unsafe {
        let told = &mut *environment.cast::<Vec<(c_int, String)>>();
        told.push((status, CStr::from_ptr(message).to_str().unwrap().to_owned()));
    }
}

/// An instance in an importer's hands. All calls return the status.
pub struct Importer {
    instance: *mut c_void,
    // The instance holds its address, so it may not move with this struct.
    #[expect(clippy::box_collection)]
    pub told: Box<Vec<(c_int, String)>>,
    references: BTreeMap<String, u32>,
    pub states: usize,
}

impl Drop for Importer {
    fn drop(&mut self) {
        // SAFETY: made once, freed once.
        unsafe { fmi3FreeInstance(self.instance) }
    }
}

// SAFETY of every call below: the instance lives, and the arrays have the lengths that are given.
impl Importer {
    /// # Errors
    /// The logged messages, if there is no instance.
    pub fn new(unit: &Unpacked, is_exchange: bool) -> Result<Self, String> {
        Self::with_token(unit, is_exchange, &unit.token)
    }

    pub fn with_token(unit: &Unpacked, is_exchange: bool, token: &str) -> Result<Self, String> {
        let mut told = Box::new(Vec::<(c_int, String)>::new());
        let token = CString::new(token).unwrap();
        let path = CString::new(unit.resources.to_str().unwrap()).unwrap();
        let environment = (&raw mut *told).cast();
        let (name, none) = (c"instance".as_ptr(), std::ptr::null());
        let instance = unsafe {
            match is_exchange {
                true => fmi3InstantiateModelExchange(
                    name,
                    token.as_ptr(),
                    path.as_ptr(),
                    false,
                    false,
                    environment,
                    Some(log),
                ),
                false => fmi3InstantiateCoSimulation(
                    name,
                    token.as_ptr(),
                    path.as_ptr(),
                    false,
                    false,
                    false,
                    false,
                    none,
                    0,
                    environment,
                    Some(log),
                    std::ptr::null(),
                ),
            }
        };
        if instance.is_null() {
            return Err(told.pop().expect("a reason was told").1);
        }
        let states = unit.references.keys().filter(|name| name.starts_with("der(")).count();
        Ok(Self { instance, told, references: unit.references.clone(), states })
    }

    pub fn last(&self) -> &str {
        self.told.last().map_or("", |(_, text)| text)
    }

    pub fn reference(&self, name: &str) -> u32 {
        *self
            .references
            .get(name)
            .unwrap_or_else(|| panic!("no variable {name}: {:?}", self.references.keys()))
    }

    pub fn begin(&mut self, start: f64) -> c_int {
        let entered = unsafe { fmi3EnterInitializationMode(self.instance, false, 0.0, start, false, 0.0) };
        if entered == OK { unsafe { fmi3ExitInitializationMode(self.instance) } } else { entered }
    }

    pub fn enter_initialization(&mut self) -> c_int {
        unsafe { fmi3EnterInitializationMode(self.instance, false, 0.0, 0.0, false, 0.0) }
    }

    pub fn exit_initialization(&mut self) -> c_int {
        unsafe { fmi3ExitInitializationMode(self.instance) }
    }

    pub fn try_get(&mut self, name: &str) -> Result<f64, c_int> {
        let (reference, mut value) = (self.reference(name), f64::NAN);
        let status = unsafe { fmi3GetFloat64(self.instance, &reference, 1, &mut value, 1) };
        if status == OK { Ok(value) } else { Err(status) }
    }

    pub fn get(&mut self, name: &str) -> f64 {
        self.try_get(name).unwrap_or_else(|_| panic!("{name}: {}", self.last()))
    }

    #[allow(dead_code, reason = "for the benchmark")]
    pub fn get_all<const N: usize>(&mut self, references: [u32; N]) -> [f64; N] {
        let mut values = [f64::NAN; N];
        let status = unsafe { fmi3GetFloat64(self.instance, references.as_ptr(), N, values.as_mut_ptr(), N) };
        assert_eq!(status, OK, "{}", self.last());
        values
    }

    pub fn get_vector<const N: usize>(&mut self, name: &str) -> [f64; N] {
        std::array::from_fn(|i| self.get(&format!("{name}[{}]", i + 1)))
    }

    pub fn get_flag(&mut self, name: &str) -> bool {
        let (reference, mut value) = (self.reference(name), false);
        assert_eq!(
            unsafe { fmi3GetBoolean(self.instance, &reference, 1, &mut value, 1) },
            OK,
            "{}",
            self.last()
        );
        value
    }

    pub fn get_as_integer(&mut self, name: &str) -> c_int {
        let (reference, mut value) = (self.reference(name), 0);
        unsafe { fmi3GetInt32(self.instance, &reference, 1, &mut value, 1) }
    }

    pub fn set(&mut self, name: &str, value: f64) -> c_int {
        unsafe { fmi3SetFloat64(self.instance, &self.reference(name), 1, &value, 1) }
    }

    pub fn set_vector(&mut self, name: &str, values: &[f64]) -> c_int {
        let references: Vec<u32> =
            (1..=values.len()).map(|i| self.reference(&format!("{name}[{i}]"))).collect();
        let count = values.len();
        unsafe { fmi3SetFloat64(self.instance, references.as_ptr(), count, values.as_ptr(), count) }
    }

    pub fn do_step(&mut self, from: f64, length: f64) -> c_int {
        let (mut event, mut end, mut early, mut last) = (true, true, true, f64::NAN);
        unsafe { fmi3DoStep(self.instance, from, length, false, &mut event, &mut end, &mut early, &mut last) }
    }

    pub fn reset(&mut self) -> c_int {
        unsafe { fmi3Reset(self.instance) }
    }

    pub fn terminate(&mut self) -> c_int {
        unsafe { fmi3Terminate(self.instance) }
    }

    pub fn enter_event(&mut self) -> c_int {
        unsafe { fmi3EnterEventMode(self.instance) }
    }

    pub fn enter_continuous(&mut self) -> c_int {
        unsafe { fmi3EnterContinuousTimeMode(self.instance) }
    }

    /// Updates discrete states; returns true if the event has changed states.
    pub fn update(&mut self) -> bool {
        self.try_update().unwrap_or_else(|_| panic!("{}", self.last()))
    }

    /// Updates discrete states; returns true if the event has changed states, or the status as the error.
    pub fn try_update(&mut self) -> Result<bool, c_int> {
        let (mut a, mut b, mut c, mut changed, mut d, mut next) = (true, true, true, false, true, 0.0);
        let status = unsafe {
            fmi3UpdateDiscreteStates(self.instance, &mut a, &mut b, &mut c, &mut changed, &mut d, &mut next)
        };
        if status != OK {
            return Err(status);
        }
        assert_eq!((a, b, c, d), (false, false, false, false), "{}", self.last());
        Ok(changed)
    }

    pub fn set_time(&mut self, time: f64) -> c_int {
        unsafe { fmi3SetTime(self.instance, time) }
    }

    pub fn set_states(&mut self, x: &[f64]) -> c_int {
        unsafe { fmi3SetContinuousStates(self.instance, x.as_ptr(), x.len()) }
    }

    pub fn states(&mut self) -> Vec<f64> {
        let mut x = vec![f64::NAN; self.states];
        let status = unsafe { fmi3GetContinuousStates(self.instance, x.as_mut_ptr(), x.len()) };
        assert_eq!(status, OK, "{}", self.last());
        x
    }

    pub fn try_rates(&mut self) -> Result<Vec<f64>, c_int> {
        let mut dx = vec![f64::NAN; self.states];
        let status = unsafe { fmi3GetContinuousStateDerivatives(self.instance, dx.as_mut_ptr(), dx.len()) };
        if status == OK { Ok(dx) } else { Err(status) }
    }

    /// Completes a step; returns true if an event must follow.
    pub fn completed(&mut self) -> bool {
        let (mut event, mut end) = (false, true);
        let status = unsafe { fmi3CompletedIntegratorStep(self.instance, false, &mut event, &mut end) };
        assert_eq!((status, end), (OK, false), "{}", self.last());
        event
    }

    pub fn save(&mut self) -> Vec<u8> {
        let (mut state, mut size) = (std::ptr::null_mut(), 0);
        unsafe {
            assert_eq!(fmi3GetFMUState(self.instance, &mut state), OK, "{}", self.last());
            assert_eq!(fmi3SerializedFMUStateSize(self.instance, state, &mut size), OK);
            let mut bytes = vec![0; size];
            assert_eq!(fmi3SerializeFMUState(self.instance, state, bytes.as_mut_ptr(), size - 1), ERROR);
            assert_eq!(fmi3SerializeFMUState(self.instance, state, bytes.as_mut_ptr(), size), OK);
            // Overwrites the existing state.
            assert_eq!(fmi3GetFMUState(self.instance, &mut state), OK);
            assert_eq!(fmi3FreeFMUState(self.instance, &mut state), OK);
            assert!(state.is_null());
            bytes
        }
    }

    pub fn restore(&mut self, bytes: &[u8]) -> c_int {
        let mut state = std::ptr::null_mut();
        unsafe {
            let status = fmi3DeserializeFMUState(self.instance, bytes.as_ptr(), bytes.len(), &mut state);
            if status != OK {
                assert!(state.is_null());
                return status;
            }
            let status = fmi3SetFMUState(self.instance, state);
            assert_eq!(fmi3FreeFMUState(self.instance, &mut state), OK);
            status
        }
    }
}

pub fn scratch(test: &str) -> PathBuf {
    pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), test)
}
