/// A mass of 6 kg with friction, pushed to and fro by a hand, and against a wall once a swing: `ticks` ticks of 2 ms. It
/// returns the least share, the least energy in the tank (J), and whether it was ever in debt.
fn run(ticks: u64) -> (Real, Real, bool) {
    let mut law = OneAxis::new(&AxisParameters::default()).expect("legal");
    let (mut inputs, mut outputs) = (AxisInputs::default(), AxisOutputs::default());
    let (mut q, mut dq) = (0.0_f64, 0.0_f64);
    let (mut share, mut tank, mut debt): (Real, Real, bool) = (1.0, Real::INFINITY, false);
    for k in 0..ticks {
        // A triangle of 8 N, 4 s long: no sine, which would be most of the time.
        let phase = (k % 2000) as f64 / 2000.0;
        let tau_h = 8.0 * (4.0 * (phase - 0.5).abs() - 1.0);
        (inputs.q, inputs.tau_h) = (q, tau_h as Real);
        law.tick(&inputs, &mut outputs).expect("finite");
        share = share.min(outputs.share);
        tank = tank.min(outputs.tank);
        debt |= outputs.debt != 0;
        #[allow(clippy::unnecessary_cast, reason = "single precision in the other package")]
        let force = tau_h + outputs.tau_a as f64;
        let wall = if q > 0.3 { -2e3 * (q - 0.3) - 100.0 * dq.max(0.0) } else { 0.0 };
        dq = (dq + (force + wall) / 6.0 * 0.002) * 0.999;
        q += dq * 0.002;
    }
    (share, tank, debt)
}

#[test]
fn a_day_of_ticks_leaves_share_and_tank_as_they_were() {
    let (share, tank, debt) = run(100_000_000);
    assert_eq!(share, 1.0);
    assert!(tank > 9.0 && !debt, "{tank} J"); // E_0 = 10 J, less what an impact costs
}
