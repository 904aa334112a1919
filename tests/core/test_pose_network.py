"""The paper's network: run by NumPy, trained where Keras is installed."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from markermend.errors import FileFormatError, MethodError
from markermend.poses.networks.network import Network, load_networks, save_networks, smoothed
from markermend.poses.networks.training import Training, train_network
from markermend.poses.nuitrack import JOINTS
from markermend.poses.simulated.noise import NOISES
from markermend.repairs.skurowski2021.recurrent import can_learn

needs_extra = pytest.mark.skipif(not can_learn(), reason="the optional extra “deep” is missing")


def network(parts="both", inputs=112, units=8):
    random = np.random.default_rng(0)

    def layer(*shape):
        return random.normal(size=shape).astype(np.float32)

    return Network(
        parts,
        layer(inputs),
        np.abs(layer(inputs)) + 1,
        (layer(inputs, units), layer(units, units), layer(units, inputs)),
        (layer(units), layer(units), layer(inputs)),
    )


def poses(frames=5):
    features = np.random.default_rng(1).normal(size=(frames, len(JOINTS), 7))
    features[..., 3:] /= np.linalg.norm(features[..., 3:], axis=-1, keepdims=True)
    return features


def test_layers_are_those_of_the_paper():
    net, features = network(), poses()
    x = (features[:, 1:].reshape(5, 112) - net.centre) / net.spread
    first = np.maximum(x @ net.weights[0] + net.biases[0], 0)
    block = first + np.maximum(first @ net.weights[1] + net.biases[1], 0)
    expected = (block @ net.weights[2] + net.biases[2]).reshape(5, 16, 7)
    assert_allclose(net(features)[:, 1:, :3], expected[..., :3], rtol=1e-4)
    turned = net(features)[:, 1:, 3:]
    assert (turned[..., 3] >= 0).all()
    assert_allclose(np.linalg.norm(turned, axis=-1), 1.0)


def test_parts_leave_the_rest():
    features = poses()
    positions = network("positions", 48)(features)
    assert (positions[..., 3:] == features[..., 3:]).all()
    assert (positions[:, 1:, :3] != features[:, 1:, :3]).any()


def test_saved_and_loaded(tmp_path):
    net = network()
    save_networks({"a-both": net, "b": network("rotations", 64)}, tmp_path / "nets.npz")
    loaded = load_networks(tmp_path / "nets.npz")
    assert list(loaded) == ["a-both", "b"]
    assert_allclose(loaded["a-both"](poses()), net(poses()), rtol=0.02, atol=0.05)
    (tmp_path / "bad.npz").write_bytes(b"PK\x03\x04 no archive")
    with pytest.raises(FileFormatError, match=r"bad\.npz"):
        load_networks(tmp_path / "bad.npz")


def test_temporal_filter_keeps_parabolas_and_smooths():
    t = np.linspace(0, 1, 50)
    features = np.zeros((50, 3, 7))
    features[..., 6] = 1
    features[:, 1, 0] = t**2
    assert_allclose(smoothed(features), features, atol=1e-12)
    features[:, 1, 0] += np.random.default_rng(0).normal(0, 0.1, 50)
    assert np.std(smoothed(features)[:, 1, 0] - t**2) < 0.075


@pytest.mark.deep
@needs_extra
def test_training_learns_and_goes_on_where_it_stopped(tmp_path):
    features = np.zeros((300, len(JOINTS), 7))
    features[..., :3] = np.random.default_rng(0).normal(size=(1, len(JOINTS), 3))
    features[..., 6] = 1
    told: list[float] = []
    training = Training(epochs=4, batch=100)
    whole = train_network(
        features, NOISES["occlusions"], training=training, progress=lambda s, _: told.append(s)
    )
    assert told == [0.25, 0.5, 0.75, 1.0]

    class Stop(Exception):
        pass

    def stop(share, doing):
        if share >= 0.5:
            raise Stop

    state = tmp_path / "state.keras"
    with pytest.raises(Stop):
        train_network(
            features, NOISES["occlusions"], training=training, resume=state, progress=stop
        )
    rest = train_network(features, NOISES["occlusions"], training=training, resume=state)
    assert_allclose(rest.weights[0], whole.weights[0], atol=1e-4)
    others = (
        (features, NOISES["occlusions"], Training(epochs=5, batch=100), "both"),
        (features, NOISES["occlusions"], Training(epochs=4, batch=100, seed=1), "both"),
        (features, NOISES["both"], training, "both"),
        (features + 0.1, NOISES["occlusions"], training, "both"),
    )
    for poses, noise, how, parts in others:
        with pytest.raises(MethodError, match=r"state\.keras is the state of a training"):
            train_network(poses, noise, parts=parts, training=how, resume=state)


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "keras", None)
    with pytest.raises(MethodError, match="deep"):
        train_network(poses(), NOISES["both"])
