//! YADE on a bed: a script of our own, since there is no export for it.
//!
//! Its law of the same kind is linear, viscous and with friction. Its periodic cell is periodic along z too, so the cell is
//! twice as high as the bed and the lowest layer is held.

use super::cases::Case;
use crate::peers::Peer;
use crate::validate::scenes::keep;
use std::path::Path;
use tsubu_assemble::Law;

/// Most grains that it is asked for: it is slow, and its first sort slower.
pub const MOST: usize = 120_000;

const SCRIPT: &str = r#"# Written by `cargo xtask bench`: grains.csv under law ViscElPhys, timed.
import csv, json, math, time
from yade import *
from yade import utils
p = json.load(open("case.json"))
rows = [[float(x) for x in r] for r in list(csv.reader(open("grains.csv")))[1:]]
top = max(r[2] for r in rows)
O.periodic = True
O.cell.setBox(p["side"], p["side"], 2 * top + 4 * p["d"])
# Two equal materials in series give the constants of the contact: each has twice of them.
mat = ViscElMat(kn=2 * p["kn"], ks=2 * p["kt"], cn=2 * p["gn"], cs=2 * p["gt"],
                frictionAngle=math.atan(p["mu"]), density=p["density"])
O.materials.append(mat)
for r in rows:
    b = utils.sphere((r[0], r[1], r[2] + p["d"]), p["d"] / 2, material=mat)
    if r[2] < p["d"] * 1.05:
        b.dynamic = False
    O.bodies.append(b)
O.dt = p["dt"]
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.05 * p["d"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                    [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(gravity=(0, 0, -9.80665), damping=0),
]
O.run(10, True)
start = time.time()
O.run(p["steps"], True)
print("seconds %.6f" % (time.time() - start))
"#;

/// Writes the script and the grains.
pub fn write(folder: &Path, case: &Case) -> Result<(), String> {
    let checked = case.source.check().map_err(|e| e.to_string())?;
    let constants = tsubu_assemble::Constants::of(&checked).map_err(|e| e.to_string())?;
    let Law::SpringDashpot(of) = &constants.law else {
        return Err("YADE is asked for springs and dashpots only".into());
    };
    let law = of.law();
    let tsubu_scene::Axis::Periodic(side) = checked.scene.domain.x else {
        return Err("YADE is asked for periodic beds only".into());
    };
    let d = constants.kind.diameter();
    let values = serde_json::json!({
        "side": side, "d": d, "dt": constants.dt, "steps": 0,
        "density": constants.kind.mass / (std::f64::consts::PI / 6.0 * d.powi(3)),
        "kn": law.normal_stiffness, "kt": law.tangential_stiffness,
        "gn": law.normal_damping, "gt": law.tangential_damping, "mu": law.friction,
    });
    keep(&folder.join("case.json"), &values.to_string())?;
    keep(&folder.join("bench.py"), SCRIPT)?;
    let grains =
        std::fs::read_to_string(&case.file).map_err(|e| format!("{}: {e}", case.file.display()))?;
    keep(&folder.join("grains.csv"), &grains)
}

/// Seconds of so many steps.
pub fn seconds(peer: &Peer, folder: &Path, threads: usize, steps: u64) -> Result<f64, String> {
    let file = folder.join("case.json");
    let text = std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
    let mut values: serde_json::Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    values["steps"] = steps.into();
    keep(&file, &values.to_string())?;
    let log = peer.run_script(folder, threads, "bench.py")?;
    let line = log.text.lines().find_map(|l| l.strip_prefix("seconds "));
    line.and_then(|l| l.trim().parse().ok())
        .ok_or_else(|| "YADE printed no time".into())
}
