//! When gains are advised against.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::advice::{Advice, KT_OVER_M_MAX, MN_OVER_M_MIN, advise};
use admittance::{Gains, Settings};

const SETTINGS: Settings = Settings {
    law: admittance::Law::PassiveBounded,
    alpha: 1.0,
    T: 0.0078125,
    delayed: false,
    dq_cutoff: 0.0,
    E_0: 10.0,
    tuning_time: 0.1,
};

/// The number of the advice for a robot of 16 kg; T = 1/128 s, so that every bound below is an exact binary number.
fn number(K: f64, M_n: f64) -> i32 {
    let gains = Gains {
        M_n,
        D_n: 0.5,
        K,
        K_P: 10.0,
        f_max: 12.5,
    };
    advise(&SETTINGS, &gains, 16.0).number()
}

#[test]
fn the_papers_gains_raise_nothing() {
    let testbed = Gains {
        M_n: 5.0,
        D_n: 0.5,
        K: 30.0,
        K_P: 10.0,
        f_max: 12.5,
    };
    assert_eq!(
        advise(&Settings::default(), &testbed, 6.0),
        Advice::default()
    );
    let arm = Gains {
        D_n: 20.0,
        K: 1000.0,
        K_P: 20.0,
        ..testbed
    };
    let settings = Settings {
        T: 0.001,
        ..SETTINGS
    };
    assert_eq!(advise(&settings, &arm, 14.0), Advice::default());
}

#[test]
fn each_bound_raises_its_own_number_and_only_beyond_itself() {
    // K T/M = 0.25 at K = 512 N·s/m.
    assert_eq!(KT_OVER_M_MAX * 16.0 * 128.0, 512.0);
    assert_eq!(number(512.0, 16.0), 0);
    assert_eq!(number(513.0, 16.0), 1);
    let lightest = MN_OVER_M_MIN * 16.0;
    assert_eq!(number(512.0, lightest), 0);
    assert_eq!(number(512.0, 0.999 * lightest), 2);
    assert_eq!(number(513.0, 0.999 * lightest), 3);
}

#[test]
fn several_axes_are_advised_against_what_any_of_them_is() {
    let (stiff, light) = (
        Advice {
            stiff_coupling: true,
            light_nominal: false,
        },
        Advice {
            stiff_coupling: false,
            light_nominal: true,
        },
    );
    assert_eq!(Advice::default().or(stiff), stiff);
    assert_eq!(stiff.or(light).number(), 3);
    assert_eq!(light.or(Advice::default()).number(), 2);
}

#[test]
fn the_message_names_what_the_number_says() {
    for (K, M_n, names) in [
        (1.0, 16.0, [false, false]),
        (513.0, 16.0, [true, false]),
        (1.0, 0.1, [false, true]),
        (513.0, 0.1, [true, true]),
    ] {
        let gains = Gains {
            M_n,
            D_n: 0.5,
            K,
            K_P: 10.0,
            f_max: 12.5,
        };
        let message = advise(&SETTINGS, &gains, 16.0).message();
        assert_eq!(message.contains("K T/M_min is above"), names[0]);
        assert_eq!(message.contains("M_n is below"), names[1]);
        assert_eq!(message.is_empty(), names == [false, false]);
    }
}
