//! The rows that every FMU with this arm has: its energy, and its parameters.

/// The rows of a model with the fields `energy` ([`mechanics::arm::Energy`]) and `parameters`
/// ([`Parameters`](crate::parameters::Parameters)), between rows of its own: `ports`, the energy, `energy_and_more`, the table of
/// the arm, `sensors`. `payload` is the description of `payload.m`. The
/// caller has `Continuous`, `Fixed`, `boolean`, `real` and `unit` of [`declaration`] in scope.
#[macro_export]
macro_rules! with_arm_table {
    (
        payload: $payload:literal,
        ports: [$($port:tt)*],
        energy_and_more: [$($more:tt)*],
        sensors: [$($sensor:tt)*],
    ) => {{
        use $crate::variables::{KINETIC, POTENTIAL, range, within};
        &[
            $($port)*
            real!(energy.kinetic, unit::JOULE).output(Continuous).initially_from(KINETIC)
                .about("kinetic energy of arm, rotors and a held payload"),
            real!(energy.potential, unit::JOULE).output(Continuous).initially_from(POTENTIAL)
                .about("potential energy of the links and a held payload, 0 at the shoulder"),
            real!(energy.surface, unit::JOULE).output(Continuous)
                .about("energy stored in table and wall"),
            real!(energy.work_tau, unit::JOULE).output(Continuous)
                .about("work of tau_applied on the arm since the start"),
            real!(energy.work_f_h, unit::JOULE).output(Continuous)
                .about("work of f_h on the arm since the start"),
            real!(energy.work_f_d, unit::JOULE).output(Continuous)
                .about("work of f_d on the arm since the start"),
            real!(energy.payload, unit::JOULE).output(Continuous)
                .about("energy that payloads brought when they were gripped, less what they took along when they left"),
            real!(energy.loss_friction, unit::JOULE).output(Continuous)
                .about("heat of dry friction in the joints since the start"),
            real!(energy.loss_viscous, unit::JOULE).output(Continuous)
                .about("heat of viscous friction in the joints since the start"),
            real!(energy.loss_stop, unit::JOULE).output(Continuous)
                .about("lost at the joints' stops since the start"),
            real!(energy.loss_surface, unit::JOULE).output(Continuous)
                .about("heat of the dampers in table and wall since the start"),
            real!(energy.loss_rub, unit::JOULE).output(Continuous)
                .about("heat of friction on table and wall since the start"),
            real!(energy.loss_impact, unit::JOULE).output(Continuous)
                .about("lost in landings on table and wall since the start, of first order in the substep"),
            real!(energy.loss_grip, unit::JOULE).output(Continuous)
                .about("lost in gripping payloads since the start: momentum is kept, energy is not"),
            real!(energy.loss_step, unit::JOULE).output(Continuous)
                .about("loss of the integrator (backward Euler) since the start, of first order in the substep"),
            $($more)*
            within(real!("A1" => parameters.A_1, unit::METRE), range::A_1).parameter(Fixed)
                .about("from the yaw axis forward to the shoulder's pitch axis"),
            within(real!("L1" => parameters.L_1, unit::METRE), range::L_1).parameter(Fixed)
                .about("from the shoulder's pitch axis to the elbow's"),
            within(real!("handle.x" => parameters.handle.x, unit::METRE), range::HANDLE_X).parameter(Fixed)
                .about("handle, along link 3 from the elbow's axis"),
            within(real!("handle.z" => parameters.handle.z, unit::METRE), range::HANDLE_Z).parameter(Fixed)
                .about("handle, across link 3, up when the link is level"),
            within(real!("pad.x" => parameters.pad.x, unit::METRE), range::PAD_X).parameter(Fixed)
                .about("pad, along link 3 from the elbow's axis"),
            within(real!("pad.z" => parameters.pad.z, unit::METRE), range::PAD_Z).parameter(Fixed)
                .about("pad, across link 3, up when the link is level"),
            within(real!("link.m[i]" => parameters.link.m[3], unit::KILOGRAM), range::LINK_M[0]).parameter(Fixed)
                .about("mass of the link"),
            within(real!("link.x[i]" => parameters.link.x[3], unit::METRE), range::LINK_X[0]).parameter(Fixed)
                .about("centre of mass along the link from its joint"),
            within(real!("link.z[i]" => parameters.link.z[3], unit::METRE), range::LINK_Z[0]).parameter(Fixed)
                .about("centre of mass across the link, up when the link is level"),
            within(real!("link.I_xx[i]" => parameters.link.I_xx[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_XX[0])
                .parameter(Fixed).about("moment of inertia about the centre of mass, axis along the link"),
            within(real!("link.I_yy[i]" => parameters.link.I_yy[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_YY[0])
                .parameter(Fixed).about("moment of inertia about the centre of mass, axis of the pitch"),
            within(real!("link.I_zz[i]" => parameters.link.I_zz[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_ZZ[0])
                .parameter(Fixed).about("moment of inertia about the centre of mass, axis across the link"),
            within(real!("link.I_xz[i]" => parameters.link.I_xz[3], unit::KILOGRAM_SQUARE_METRE), range::LINK_I_XZ[0])
                .parameter(Fixed).about("element xz of the inertia matrix about the centre of mass"),
            within(real!("rotor.I[i]" => parameters.rotor_I[3], unit::KILOGRAM_SQUARE_METRE), range::ROTOR[0])
                .parameter(Fixed).about("inertia of rotor and gear about the rotor axis; at the joint it counts times gear^2"),
            within(real!("gear[i]" => parameters.gear[3], unit::NONE), range::GEAR[0]).parameter(Fixed)
                .about("gear ratio"),
            within(real!("gravity[i]" => parameters.gravity[3], unit::METRE_PER_SECOND_SQUARED), range::GRAVITY[0])
                .parameter(Fixed).about("acceleration of gravity, base frame"),
            within(real!("friction.F_c[i]" => parameters.friction.F_c[3], unit::NEWTON_METRE), range::F_C[0])
                .parameter(Fixed).about("Coulomb friction of the joint"),
            within(real!("friction.F_s[i]" => parameters.friction.F_s[3], unit::NEWTON_METRE), range::F_S[0])
                .parameter(Fixed).about("stiction of the joint, at least friction.F_c"),
            within(real!("friction.v_s[i]" => parameters.friction.v_s[3], unit::RADIAN_PER_SECOND), range::V_S[0])
                .parameter(Fixed).about("Stribeck velocity: F_c + (F_s - F_c) exp(-(dq/v_s)^2)"),
            within(real!("friction.b[i]" => parameters.friction.b[3], unit::NEWTON_METRE_SECOND_PER_RADIAN), range::B[0])
                .parameter(Fixed).about("viscous friction of the joint"),
            within(real!("stop.min[i]" => parameters.stop_min[3], unit::RADIAN), range::STOP_MIN[0]).parameter(Fixed)
                .about("lower stop of the joint, hard and inelastic"),
            within(real!("stop.max[i]" => parameters.stop_max[3], unit::RADIAN), range::STOP_MAX[0]).parameter(Fixed)
                .about("upper stop of the joint, at least stop.min"),
            within(real!("drive.cutoff" => parameters.drive_cutoff, unit::HERTZ), range::DRIVE_CUTOFF).parameter(Fixed)
                .about("corner frequency of the torque's first-order lag; 0: no lag"),
            within(real!("payload.m" => parameters.payload_m, unit::KILOGRAM), range::PAYLOAD_M).parameter(Fixed)
                .about($payload),
            boolean!("payload.attached" => parameters.payload_attached).parameter(Fixed)
                .about("whether the payload hangs at the pad from the start on"),
            within(real!("vacuum.F_max" => parameters.vacuum.F_max, unit::NEWTON), range::F_MAX).parameter(Fixed)
                .about("pull on the payload beyond which the bond breaks"),
            within(real!("vacuum.F_attach" => parameters.vacuum.F_attach, unit::NEWTON), range::F_ATTACH).parameter(Fixed)
                .about("force of the table on the pad beyond which the cup grips the payload"),
            within(real!("table.z" => parameters.table.position, unit::METRE), range::TABLE.position).parameter(Fixed)
                .about("height of the table, at most that of the pad at the start; -10: none in reach"),
            within(real!("table.k" => parameters.table.k, unit::NEWTON_PER_METRE), range::TABLE.k).parameter(Fixed)
                .about("stiffness of the table"),
            within(real!("table.c" => parameters.table.c, unit::NEWTON_SECOND_PER_METRE), range::TABLE.c)
                .parameter(Fixed).about("damping of the table"),
            within(real!("table.mu" => parameters.table.mu, unit::NONE), range::TABLE.mu).parameter(Fixed)
                .about("coefficient of friction on the table, for each tangential axis by itself"),
            within(real!("wall.x" => parameters.wall.position, unit::METRE), range::WALL.position).parameter(Fixed)
                .about("distance of the wall ahead, at least that of the pad at the start; 10: none in reach"),
            within(real!("wall.k" => parameters.wall.k, unit::NEWTON_PER_METRE), range::WALL.k).parameter(Fixed)
                .about("stiffness of the wall"),
            within(real!("wall.c" => parameters.wall.c, unit::NEWTON_SECOND_PER_METRE), range::WALL.c)
                .parameter(Fixed).about("damping of the wall"),
            within(real!("wall.mu" => parameters.wall.mu, unit::NONE), range::WALL.mu).parameter(Fixed)
                .about("coefficient of friction on the wall, for each tangential axis by itself"),
            within(real!("q_start[i]" => parameters.q_start[3], unit::RADIAN), range::Q_START[0]).parameter(Fixed)
                .about("start angle of the joint, between its stops"),
            within(real!("dq_start[i]" => parameters.dq_start[3], unit::RADIAN_PER_SECOND), range::DQ_START[0])
                .parameter(Fixed).about("start velocity of the joint"),
            $($sensor)*
        ]
    }};
}
